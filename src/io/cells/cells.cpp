#include <limits>
#include <string>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/cells/split_cells.hpp>

namespace gale::io::detail {
namespace {

/// The values as T, without a copy if they are. Throws gale::Error for one that T doesn't hold. `what` they are.
template <class T>
std::vector<T> taken_as(PointArray::Values& values, const char* what) {
  if (auto* const same = std::get_if<std::vector<T>>(&values)) return std::move(*same);
  return std::visit(
      [&](const auto& from) {
        std::vector<T> to(from.size());
        if (!std::is_integral_v<typename std::decay_t<decltype(from)>::value_type>)
          damaged("its ", what, " are no whole numbers");
        for (std::size_t k = 0; k < from.size(); ++k) {
          gale::detail::stop_if_asked_at(static_cast<Offset>(k));
          to[k] = static_cast<T>(from[k]);
          const bool fits =
              static_cast<std::decay_t<decltype(from[k])>>(to[k]) == from[k] && (to[k] < 0) == (from[k] < 0);
          if (!fits) damaged("one of its ", what, " is ", from[k]);
        }
        return to;
      },
      values);
}

template <class T>
Array<const T, HostMemory> view_of(const std::vector<T>& values) {
  return Array<const T, HostMemory>(values.data(), values.size());
}

template <class Index>
SplitCells<4, HostMemory> split_by(Cells& cells, std::size_t points, const Array<const GlobalId, HostMemory>& ids,
                                   const ReadOptions& options) {
  const auto types = taken_as<std::uint8_t>(cells.types, "types");
  auto offsets = taken_as<Offset>(cells.ends, "offsets");
  if (types.size() != offsets.size())
    damaged("it has types of ", types.size(), " cells and offsets of ", offsets.size());
  offsets.insert(offsets.begin(), 0);
  const std::string others = options.tetrahedra_alone ? other_cells(view_of(types)) : "";
  if (!others.empty()) refuse("it has ", others, ", and tetrahedra alone are wanted");
  const auto connectivity = taken_as<Index>(cells.connectivity, "connectivities");
  const gale::Cells<Index, HostMemory> all{view_of(types), view_of(offsets), view_of(connectivity)};
  return gale::split_cells(all, static_cast<Offset>(points), ids);
}

std::size_t point_count_of(const Dataset& mesh) {
  return std::visit([](const auto& points) { return points.extent(0); }, mesh.points);
}

template <class Coordinate>
Dataset::Points<Coordinate> to_points(const PointArray::Values& values) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", count_of(values) / 3);
  std::visit(
      [&](const auto& from) {
        parallel_for("GALE::copy_points", HostExecutionSpace(), points.extent(0), [&](Offset i) {
          for (int d = 0; d < 3; ++d) points(i, d) = static_cast<Coordinate>(from[3 * i + d]);
        });
      },
      values);
  return points;
}

}  // namespace

std::string note_array(const std::string& name, const std::string& why) {
  return "left out the point array '" + name + "': " + why;
}

std::string note_cell_arrays(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return "left out the cell arrays " + list;
}

std::vector<std::string> split_into(Dataset& to, Cells& cells, const Array<const GlobalId, HostMemory>& ids,
                                    const ReadOptions& options) {
  const std::size_t points = point_count_of(to);
  const bool is_short = std::holds_alternative<std::vector<std::int32_t>>(cells.connectivity);
  const auto split = is_short ? split_by<std::int32_t>(cells, points, ids, options)
                              : split_by<std::int64_t>(cells, points, ids, options);
  cells = {};
  to.tetrahedra = split.simplices;
  if (split.cells.extent(0) > 0) {
    const Id* const first = split.cells.data();
    to.cell_arrays.push_back({global_cell_ids, 1, std::vector<Id>(first, first + split.cells.extent(0))});
  }
  return split.notices;
}

Dataset to_points_alone(MeshParts& parts) {
  const std::size_t points = count_of(parts.points) / 3;
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<Id>::max());
  if (points > most) refuse("it has ", points, " points, more than the ", most, " that 32-bit ids can number");
  for (const PointArray& array : parts.arrays) require_size(array, points);
  Dataset mesh;
  if (std::holds_alternative<std::vector<double>>(parts.points)) {
    mesh.points = to_points<double>(parts.points);
  } else {
    mesh.points = to_points<float>(parts.points);
  }
  parts.points = std::vector<float>();
  mesh.arrays = std::move(parts.arrays);
  mesh.notices = std::move(parts.notices);
  return mesh;
}

Dataset to_mesh(MeshParts& parts, const ReadOptions& options) {
  Dataset mesh = to_points_alone(parts);
  const bool has_cells = count_of(parts.cells.types) > 0;
  const std::vector<std::string> notices = split_into(mesh, parts.cells, {}, options);
  if (mesh.tetrahedra.extent(0) == 0) {
    const bool has_split = has_cells && !notices.empty() && notices.front().rfind("split ", 0) == 0;
    throw Error(std::string("it has no tetrahedra") + (has_split ? ": its cells have no volume" : ""));
  }
  mesh.notices.insert(mesh.notices.begin(), notices.begin(), notices.end());
  return mesh;
}

Cells cells_of_grid(const std::array<std::int64_t, 3>& dimensions, int type) {
  const auto [nx, ny, nz] = dimensions;
  if (nx < 2 || ny < 2 || nz < 2) return MeshParts().cells;
  static constexpr int places[2][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 3, 2, 4, 5, 7, 6}};
  const int* const corners = places[type == cell_type::hexahedron];
  const std::int64_t width = nx - 1, height = ny - 1, row = nx, layer = nx * ny, count = width * height * (nz - 1);
  std::vector<std::int32_t> connectivity(8 * static_cast<std::size_t>(count));
  std::vector<std::int64_t> ends(static_cast<std::size_t>(count));
  parallel_for("GALE::cells_of_grid", HostExecutionSpace(), count, [&](Offset cell) {
    const std::int64_t first = cell / width / height * layer + cell / width % height * row + cell % width;
    for (int k = 0; k < 8; ++k) {
      const int corner = corners[k];
      connectivity[8 * cell + k] =
          static_cast<std::int32_t>(first + (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * layer);
    }
    ends[cell] = 8 * (cell + 1);
  });
  return {std::vector<std::uint8_t>(ends.size(), static_cast<std::uint8_t>(type)), std::move(ends),
          std::move(connectivity)};
}

}  // namespace gale::io::detail
