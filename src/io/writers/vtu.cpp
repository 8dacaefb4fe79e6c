#include <algorithm>

#include <gale/io/writers/write_xml.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {

namespace {

using Arrays = std::vector<WrittenArray>;

enum VtkCell : std::uint8_t { line = 3, polyline = 4, tetrahedron = 10 };

/// The name, where one of the arrays has it.
std::string among(const Arrays& arrays, const std::string& name) {
  const bool is_there =
      std::any_of(arrays.begin(), arrays.end(), [&](const auto& array) { return array.name == name; });
  return is_there ? name : "";
}

void write(const AtomicFile& file, const Dataset::Positions& points, Arrays point_arrays, Arrays cell_arrays,
           Arrays cells) {
  const std::string point_ids = among(point_arrays, global_point_ids), cell_ids = among(cell_arrays, global_cell_ids);
  write_xml(file, {"UnstructuredGrid",
                   {{"NumberOfPoints", written(points).count / 3}, {"NumberOfCells", cells[1].count}},
                   {{"PointData", std::move(point_arrays), point_ids},
                    {"CellData", std::move(cell_arrays), cell_ids},
                    {"Points", {written(points)}, ""},
                    {"Cells", std::move(cells), ""}}});
}

}  // namespace

void write_vtu(const AtomicFile& file, const Dataset& mesh, const std::vector<PointArray>& more,
               const std::vector<PointArray>& cell_arrays) {
  const std::uint64_t count = mesh.tetrahedra.extent(0);
  write(file, mesh.points, written({&mesh.arrays, &more}), written({&cell_arrays}),
        {made_integers("connectivity", 4 * count, 4 * count,
                       [corners = mesh.tetrahedra.data()](std::uint64_t k) { return corners[k]; }),
         made_integers("offsets", count, 4 * count, [](std::uint64_t k) { return 4 * (k + 1); }),
         made<std::uint8_t>("types", count, [](std::uint64_t) { return tetrahedron; })});
}

void write_vtu(const AtomicFile& file, const Surface& lines) {
  const auto* const begin = lines.lines.begin.data();
  const std::uint64_t count = lines.lines.begin.size() - 1, size = lines.lines.points.size();
  write(file, lines.points, written({&lines.point_arrays}), written({&lines.cell_arrays}),
        {made_integers("connectivity", size, size,
                       [points = lines.lines.points.data()](std::uint64_t k) { return points[k]; }),
         made_integers("offsets", count, size, [begin](std::uint64_t k) { return begin[k + 1]; }),
         made<std::uint8_t>("types", count,
                            [begin](std::uint64_t k) { return begin[k + 1] - begin[k] == 2 ? line : polyline; })});
}

}  // namespace gale::io::detail
