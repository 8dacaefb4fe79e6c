#include <algorithm>

#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {
namespace {

enum VtkCell : std::uint8_t { vtk_line = 3, vtk_polyline = 4 };

template <class T>
WrittenArray of_values(const std::string& name, int components, const T* values, std::uint64_t count) {
  return {name,
          components,
          value_type_of<T>(),
          count,
          [values](std::uint64_t begin, std::uint64_t end, char* to) {
            if (end > begin) std::memcpy(to, values + begin, (end - begin) * sizeof(T));
          },
          reinterpret_cast<const char*>(values)};
}

/// The points of cells, and where each cell ends.
WrittenArrays cells_of(const Surface::Cells& cells) {
  const std::uint64_t size = cells.points.size();
  return {
      made_integers("connectivity", size, size, [points = cells.points.data()](std::uint64_t k) { return points[k]; }),
      made_integers("offsets", cells.begin.size() - 1, size,
                    [begin = cells.begin.data()](std::uint64_t cell) { return begin[cell + 1]; })};
}

/// The vertices of simplices, and where each ends.
WrittenArrays simplices_of(const WrittenCells& cells) {
  const std::uint64_t size = cells.corners * cells.count;
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  return {size <= most ? cells.connectivity<std::int32_t>("connectivity")
                       : cells.connectivity<std::int64_t>("connectivity"),
          made_integers("offsets", cells.count, size,
                        [corners = cells.corners](std::uint64_t k) { return corners * (k + 1); })};
}

/// Makes each point a cell.
WrittenArrays vertices(std::uint64_t count) {
  return {made_integers("connectivity", count, count, [](std::uint64_t k) { return k; }),
          made_integers("offsets", count, count, [](std::uint64_t k) { return k + 1; })};
}

/// A section with the name, where one of its arrays has it, of the array of global ids.
XmlContent::Section with_ids(const std::string& section, WrittenArrays arrays, const std::string& ids) {
  const bool has = std::any_of(arrays.begin(), arrays.end(), [&](const auto& array) { return array.name == ids; });
  return {section, std::move(arrays), has ? ids : ""};
}

XmlContent poly_data(const Dataset::Positions& points, WrittenArrays point_arrays, WrittenArrays cell_arrays,
                     WrittenArrays verts, WrittenArrays lines, WrittenArrays polygons) {
  const auto count = [](const WrittenArrays& cells) { return cells[1].count; };
  return {"PolyData",
          {{"NumberOfPoints", written(points).count / 3},
           {"NumberOfVerts", count(verts)},
           {"NumberOfLines", count(lines)},
           {"NumberOfStrips", 0},
           {"NumberOfPolys", count(polygons)}},
          {{"PointData", std::move(point_arrays)},
           {"CellData", std::move(cell_arrays)},
           {"Points", {written(points)}},
           {"Verts", std::move(verts)},
           {"Lines", std::move(lines)},
           {"Strips", vertices(0)},
           {"Polys", std::move(polygons)}}};
}

XmlContent unstructured_grid(const Dataset::Positions& points, WrittenArrays point_arrays, WrittenArrays cell_arrays,
                             WrittenArrays cells) {
  return {"UnstructuredGrid",
          {{"NumberOfPoints", written(points).count / 3}, {"NumberOfCells", cells[1].count}},
          {with_ids("PointData", std::move(point_arrays), global_point_ids),
           with_ids("CellData", std::move(cell_arrays), global_cell_ids),
           {"Points", {written(points)}},
           {"Cells", std::move(cells)}}};
}

}  // namespace

WrittenArray written(const Dataset::Positions& points) {
  return std::visit([](const auto& xyz) { return of_values("Points", 3, xyz.data(), 3 * xyz.extent(0)); }, points);
}

WrittenArrays written(const std::vector<PointArray>& arrays, const std::vector<PointArray>& more) {
  WrittenArrays all;
  for (const auto* some : {&arrays, &more}) {
    for (const PointArray& array : *some) {
      const std::string name = array.name.empty() ? "unnamed" : array.name;
      WrittenArray one = std::visit(
          [&](const auto& values) { return of_values(name, array.components, values.data(), values.size()); },
          array.values);
      const auto before =
          std::find_if(all.begin(), all.end(), [&](const WrittenArray& other) { return other.name == name; });
      if (before == all.end()) {
        all.push_back(std::move(one));
      } else {
        *before = std::move(one);
      }
    }
  }
  return all;
}

XmlContent content_of(const PointSet& points) {
  const std::uint64_t count = written(points.points).count / 3;
  return poly_data(points.points, written(points.arrays), {}, vertices(count), vertices(0), vertices(0));
}

XmlContent content_of(const Surface& surface) {
  return poly_data(surface.points, written(surface.point_arrays), written(surface.cell_arrays), vertices(0),
                   cells_of(surface.lines), cells_of(surface.polygons));
}

XmlContent content_of(const Dataset& mesh, const std::vector<PointArray>& more,
                      const std::vector<PointArray>& cell_arrays) {
  const WrittenCells cells(mesh);
  WrittenArrays arrays = simplices_of(cells);
  arrays.push_back(made<std::uint8_t>("types", cells.count, [type = cells.type](std::uint64_t) { return type; }));
  return unstructured_grid(mesh.points, written(mesh.arrays, more), written(cell_arrays), std::move(arrays));
}

XmlContent content_of_triangles(const Dataset& mesh, const std::vector<PointArray>& more,
                                const std::vector<PointArray>& cell_arrays) {
  return poly_data(mesh.points, written(mesh.arrays, more), written(cell_arrays), vertices(0), vertices(0),
                   simplices_of(WrittenCells(mesh)));
}

XmlContent content_of_lines(const Surface& lines) {
  WrittenArrays cells = cells_of(lines.lines);
  const auto type = [begin = lines.lines.begin.data()](std::uint64_t k) {
    return begin[k + 1] - begin[k] == 2 ? vtk_line : vtk_polyline;
  };
  cells.push_back(made<std::uint8_t>("types", cells[1].count, type));
  return unstructured_grid(lines.points, written(lines.point_arrays), written(lines.cell_arrays), std::move(cells));
}

}  // namespace gale::io::detail
