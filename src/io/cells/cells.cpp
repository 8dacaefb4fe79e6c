#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
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

/// Cells whose types and offsets have the types that splitting takes, and which were counted.
struct CountedCells {
  std::vector<std::uint8_t> types;
  std::vector<Offset> offsets;
};

CountedCells counted(FileCells& cells) {
  CountedCells counted{taken_as<std::uint8_t>(cells.types, "types"), taken_as<Offset>(cells.ends, "offsets")};
  if (counted.types.size() != counted.offsets.size())
    damaged("it has types of ", counted.types.size(), " cells and offsets of ", counted.offsets.size());
  counted.offsets.insert(counted.offsets.begin(), 0);
  return counted;
}

void refuse_other_cells(const CountedCells& cells, int dimension) {
  const std::string others = other_cells(view_of(cells.types), dimension);
  if (!others.empty())
    refuse("it has ", others, ", and ", dimension == 3 ? "tetrahedra" : "triangles", " alone are wanted");
}

/// What cells of one kind of index are split into. Takes the connectivity, and frees it.
template <int Corners, class Index>
SplitCells<Corners, HostMemory> split_by(const CountedCells& counted, PointArray::Values& connectivity,
                                         std::size_t points, const Array<const GlobalId, HostMemory>& ids) {
  const auto corners = taken_as<Index>(connectivity, "connectivities");
  connectivity = {};
  const gale::Cells<Index, HostMemory> all{view_of(counted.types), view_of(counted.offsets), view_of(corners)};
  if constexpr (Corners == 4) {
    return gale::split_cells(all, static_cast<Offset>(points), ids);
  } else {
    return gale::split_polygons(all, static_cast<Offset>(points), ids);
  }
}

/// Gives the mesh the simplices that cells are split into, and returns the notices.
template <int Corners, class Simplices>
std::vector<std::string> split(const CountedCells& counted, PointArray::Values& connectivity,
                               const Array<const GlobalId, HostMemory>& ids, Simplices& simplices, Dataset& to) {
  const auto points = static_cast<std::size_t>(to.vertices());
  const bool is_long = std::holds_alternative<std::vector<std::uint32_t>>(connectivity) ||
                       std::holds_alternative<std::vector<std::int64_t>>(connectivity) ||
                       std::holds_alternative<std::vector<std::uint64_t>>(connectivity);
  const SplitCells<Corners, HostMemory> split =
      is_long ? split_by<Corners, std::int64_t>(counted, connectivity, points, ids)
              : split_by<Corners, std::int32_t>(counted, connectivity, points, ids);
  simplices = split.simplices;
  if (split.cells.extent(0) > 0) {
    const Id* const first = split.cells.data();
    to.cell_arrays.push_back({global_cell_ids, 1, std::vector<Id>(first, first + split.cells.extent(0))});
  }
  return split.notices;
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

template <class T>
PointArray::Values interleaved_as(const std::vector<PointArray::Values>& axes, std::size_t points) {
  std::vector<T> xyz(3 * points);
  for (std::size_t d = 0; d < axes.size(); ++d) {
    std::visit(
        [&](const auto& from) {
          for (std::size_t k = 0; k < points; ++k) xyz[3 * k + d] = static_cast<T>(from[k]);
        },
        axes[d]);
  }
  return xyz;
}

}  // namespace

PointArray::Values interleaved(const std::vector<PointArray::Values>& axes, std::size_t points) {
  const bool are_float = std::all_of(axes.begin(), axes.end(), [](const PointArray::Values& axis) {
    return std::holds_alternative<std::vector<float>>(axis);
  });
  return are_float ? interleaved_as<float>(axes, points) : interleaved_as<double>(axes, points);
}

PointArray::Values points_along(const std::array<std::vector<double>, 3>& axes, bool are_float) {
  const auto placed = [&](auto coordinate) -> PointArray::Values {
    std::vector<decltype(coordinate)> points;
    points.reserve(3 * axes[0].size() * axes[1].size() * axes[2].size());
    for (const double z : axes[2]) {
      for (const double y : axes[1]) {
        gale::detail::stop_if_asked();
        for (const double x : axes[0]) {
          for (const double at : {x, y, z}) points.push_back(static_cast<decltype(coordinate)>(at));
        }
      }
    }
    return points;
  };
  return are_float ? placed(float()) : placed(double());
}

std::string note_array(const std::string& name, const std::string& why) {
  return "left out the point array '" + name + "': " + why;
}

std::string note_cell_arrays(const std::vector<std::string>& names) {
  return "left out the cell arrays '" + joined(names, "', '") + "'";
}

std::vector<std::string> split_into(Dataset& to, FileCells& cells, const Array<const GlobalId, HostMemory>& ids,
                                    const ReadOptions& options, std::optional<int> dimension) {
  const CountedCells counted_cells = counted(cells);
  const bool is_flat = dimension.value_or(highest_dimension(view_of(counted_cells.types))) == 2;
  if (options.simplices_alone) refuse_other_cells(counted_cells, is_flat ? 2 : 3);
  std::vector<std::string> notices = is_flat ? split<3>(counted_cells, cells.connectivity, ids, to.triangles, to)
                                             : split<4>(counted_cells, cells.connectivity, ids, to.tetrahedra, to);
  cells = {};
  return notices;
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
  const std::vector<std::string> notices = split_into(mesh, parts.cells, {}, options);
  if (mesh.cells() == 0) {
    const bool has_split = !notices.empty() && notices.front().rfind("split ", 0) == 0;
    const bool has_volumes = has_split && notices.front().find(" tetrahedra") != std::string::npos;
    throw Error(has_split ? has_volumes ? "it has no tetrahedra: its cells have no volume"
                                        : "it has no triangles: its cells have no area"
                          : "it has no tetrahedra and no triangles");
  }
  mesh.notices.insert(mesh.notices.begin(), notices.begin(), notices.end());
  return mesh;
}

namespace {

/// Cells of a grid, each of so many `corners`: steps to these from the lowest one, which is at place(cell).
template <class Place>
FileCells tabulated_cells(std::int64_t count, int type, const std::vector<std::int64_t>& steps, const Place& place) {
  const auto corners = static_cast<std::int64_t>(steps.size());
  std::vector<std::int32_t> connectivity(steps.size() * static_cast<std::size_t>(count));
  std::vector<std::int64_t> ends(static_cast<std::size_t>(count));
  parallel_for("GALE::cells_of_grid", HostExecutionSpace(), count, [&](Offset cell) {
    const std::int64_t first = place(cell);
    for (std::int64_t k = 0; k < corners; ++k)
      connectivity[corners * cell + k] = static_cast<std::int32_t>(first + steps[k]);
    ends[cell] = corners * (cell + 1);
  });
  return {std::vector<std::uint8_t>(ends.size(), static_cast<std::uint8_t>(type)), std::move(ends),
          std::move(connectivity)};
}

}  // namespace

FileCells cells_of_grid(const std::array<std::int64_t, 3>& dimensions, int type) {
  const bool are_hexahedra = type == cell_type::hexahedron;
  std::array<std::int64_t, 3> sizes = dimensions;
  std::stable_partition(sizes.begin(), sizes.end(), [](std::int64_t size) { return size != 1; });
  const auto [nx, ny, nz] = sizes;
  if (nx < 2 || ny < 2 || nz < 1) return MeshParts().cells;
  const std::int64_t width = nx - 1, height = ny - 1, row = nx, layer = nx * ny;
  if (nz < 2) {
    const auto steps =
        are_hexahedra ? std::vector<std::int64_t>{0, 1, row + 1, row} : std::vector<std::int64_t>{0, 1, row, row + 1};
    return tabulated_cells(width * height, are_hexahedra ? cell_type::quad : cell_type::pixel, steps,
                           [=](std::int64_t cell) { return cell / width * row + cell % width; });
  }
  std::vector<std::int64_t> steps;
  for (const int corner :
       {0, 1, are_hexahedra ? 3 : 2, are_hexahedra ? 2 : 3, 4, 5, are_hexahedra ? 7 : 6, are_hexahedra ? 6 : 7})
    steps.push_back((corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * layer);
  return tabulated_cells(width * height * (nz - 1), type, steps, [=](std::int64_t cell) {
    return cell / width / height * layer + cell / width % height * row + cell % width;
  });
}

}  // namespace gale::io::detail
