#include <type_traits>
#include <utility>
#include <vector>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/cells/surface_cells.hpp>

namespace gale::io::detail {
namespace {

constexpr std::uint8_t poly_line = 4;

/// Whether the three points from `at` on, which are there, aren't all different.
bool has_point_twice(const PointArray::Values& connectivity, std::int64_t at) {
  return std::visit(
      [&](const auto& points) {
        const auto* const p = points.data() + at;
        return p[0] == p[1] || p[1] == p[2] || p[0] == p[2];
      },
      connectivity);
}

/// Adds the types of polygons by their sizes, whatever these are: who splits them checks where they end.
void add_polygon_types(const CellsOfKind& polygons, std::vector<std::uint8_t>& types) {
  const auto size = static_cast<std::int64_t>(count_of(polygons.connectivity));
  std::visit(
      [&](const auto& ends) {
        std::int64_t begin = 0;
        for (std::size_t k = 0; k < ends.size(); ++k) {
          gale::detail::stop_if_asked_at(static_cast<std::int64_t>(k));
          const auto end = static_cast<std::int64_t>(ends[k]);
          const bool is_inside = begin >= 0 && end >= begin && end <= size;
          const std::int64_t points = is_inside ? end - begin : 0;
          int type = points == 3 ? cell_type::triangle : points == 4 ? cell_type::quad : cell_type::polygon;
          if (points == 3 && has_point_twice(polygons.connectivity, begin)) type = poly_line;
          types.push_back(static_cast<std::uint8_t>(type));
          begin = end;
        }
      },
      polygons.ends);
}

/// Throws gale::Error unless cells end at whole numbers inside of their connectivity, which loses what is behind the
/// last: other cells follow it.
void trim(CellsOfKind& cells, const char* kind) {
  const auto size = static_cast<std::int64_t>(count_of(cells.connectivity));
  std::int64_t end = 0;
  std::visit(
      [&](const auto& ends) {
        if (!std::is_integral_v<typename std::decay_t<decltype(ends)>::value_type>)
          damaged("the offsets of its ", kind, "s are no whole numbers");
        for (std::size_t k = 0; k < ends.size(); ++k) {
          end = static_cast<std::int64_t>(ends[k]);
          if (end < 0 || end > size) damaged(kind, " ", k, " ends at ", end, " in a connectivity of ", size);
        }
      },
      cells.ends);
  std::visit([&](auto& points) { points.resize(static_cast<std::size_t>(end)); }, cells.connectivity);
}

}  // namespace

FileCells cells_of_surface(SurfaceCells from) {
  trim(from.polygons, "polygon");
  trim(from.strips, "strip");
  std::vector<std::uint8_t> types(from.below, poly_line);
  types.reserve(from.below + count_of(from.polygons.ends) + count_of(from.strips.ends));
  add_polygon_types(from.polygons, types);
  if (from.below == 0 && count_of(from.strips.ends) == 0)
    return {std::move(types), std::move(from.polygons.ends), std::move(from.polygons.connectivity)};
  types.resize(types.size() + count_of(from.strips.ends), static_cast<std::uint8_t>(cell_type::triangle_strip));
  std::vector<std::int64_t> ends(from.below, 0), connectivity;
  append(from.polygons.ends, std::int64_t(0), ends);
  append(from.strips.ends, static_cast<std::int64_t>(count_of(from.polygons.connectivity)), ends);
  append(from.polygons.connectivity, std::int64_t(0), connectivity);
  append(from.strips.connectivity, std::int64_t(0), connectivity);
  return {std::move(types), std::move(ends), std::move(connectivity)};
}

}  // namespace gale::io::detail
