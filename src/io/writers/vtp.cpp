#include <algorithm>

#include <gale/io/writers/write_xml.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {

namespace {

using Arrays = std::vector<WrittenArray>;

Arrays cells_of(const Surface::Cells& cells) {
  const std::uint64_t size = cells.points.size();
  return {
      made_integers("connectivity", size, size, [points = cells.points.data()](std::uint64_t k) { return points[k]; }),
      made_integers("offsets", cells.begin.size() - 1, size,
                    [begin = cells.begin.data()](std::uint64_t cell) { return begin[cell + 1]; })};
}

/// Each point a cell.
Arrays vertices(std::uint64_t count) {
  return {made_integers("connectivity", count, count, [](std::uint64_t k) { return k; }),
          made_integers("offsets", count, count, [](std::uint64_t k) { return k + 1; })};
}

struct Parts {
  const Dataset::Positions& points;
  Arrays point_arrays, cell_arrays;
  Arrays vertices, lines, polygons;
};

void write(const AtomicFile& file, const Parts& parts) {
  const auto count = [](const Arrays& cells) { return cells[1].count; };
  write_xml(file, {"PolyData",
                   {{"NumberOfPoints", written(parts.points).count / 3},
                    {"NumberOfVerts", count(parts.vertices)},
                    {"NumberOfLines", count(parts.lines)},
                    {"NumberOfStrips", 0},
                    {"NumberOfPolys", count(parts.polygons)}},
                   {{"PointData", parts.point_arrays, ""},
                    {"CellData", parts.cell_arrays, ""},
                    {"Points", {written(parts.points)}, ""},
                    {"Verts", parts.vertices, ""},
                    {"Lines", parts.lines, ""},
                    {"Strips", vertices(0), ""},
                    {"Polys", parts.polygons, ""}}});
}

}  // namespace

void write_vtp(const AtomicFile& file, const PointSet& points) {
  const std::uint64_t count = written(points.points).count / 3;
  write(file, {points.points, written({&points.arrays}), {}, vertices(count), vertices(0), vertices(0)});
}

void write_vtp(const AtomicFile& file, const Surface& surface) {
  write(file, {surface.points, written({&surface.point_arrays}), written({&surface.cell_arrays}), vertices(0),
               cells_of(surface.lines), cells_of(surface.polygons)});
}

}  // namespace gale::io::detail
