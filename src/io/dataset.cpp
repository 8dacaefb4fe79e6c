#include <gale/base/memory.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

using detail::refuse;

namespace {

/// All cells of a grid, in their order.
template <class Cells>
Cells cells_of_grid(const char* label, const Grid& grid) {
  const auto cells = allocate<Cells>(label, grid.cells());
  grid.write_cells(cells);
  return cells;
}

}  // namespace

void write_out_cells(Dataset& dataset) {
  if (!dataset.grid) return;
  const Grid& grid = *dataset.grid;
  if (grid.dimension() == 3) {
    dataset.tetrahedra = cells_of_grid<decltype(Dataset::tetrahedra)>("GALE::tetrahedra", grid);
  } else {
    dataset.triangles = cells_of_grid<decltype(Dataset::triangles)>("GALE::triangles", grid);
  }
  dataset.grid.reset();
}

std::size_t point_count(const PointArray& array) {
  const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
  return array.components > 0 ? values / array.components : 0;
}

PointArray extract_component(const PointArray& array, int component) {
  if (component < 0 || component >= array.components)
    refuse("the array '", array.name, "' has ", array.components, " components, no ", component);
  const std::size_t rows = point_count(array), width = array.components;
  const auto pick = [&](const auto& from) -> PointArray::Values {
    std::decay_t<decltype(from)> to(rows);
    for (std::size_t row = 0; row < rows; ++row) to[row] = from[row * width + component];
    return to;
  };
  return {array.name + "_" + std::to_string(component), 1, std::visit(pick, array.values)};
}

void detail::refuse_row(const PointArray& array, std::size_t row) {
  refuse("the array '", array.name, "' has ", point_count(array), " rows, no row ", static_cast<std::int64_t>(row));
}

}  // namespace gale::io
