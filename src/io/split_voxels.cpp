#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/image.hpp>

namespace gale::io {
namespace {

using detail::refuse;

using Host = Kokkos::DefaultHostExecutionSpace;

/// The image as rows of voxels along x; row (y, z) is number z*ny + y. Of a plane the two axes along it are x and y,
/// which doesn't change the order of its voxels, and cubes are squares.
struct VoxelRows {
  int nx, ny, nz;

  bool is_plane() const { return nz == 1; }

  Offset count() const { return Offset(ny) * nz; }
  std::size_t begin(Offset row) const { return std::size_t(row) * nx; }
};

/// A bit for each voxel for which `test` holds, as Grid takes them.
template <class Values, class Test>
Array<std::uint64_t, HostMemory> mark(const VoxelRows& rows, const Values& values, const Test& test) {
  const std::size_t words = Grid::words_of_row(rows.nx);
  const auto bits = allocate<Array<std::uint64_t, HostMemory>>("GALE::inside", words * rows.count());
  parallel_for("GALE::mark_inside", Host(), rows.count(), [&](Offset row) {
    const auto* in = &values[rows.begin(row)];
    std::uint64_t* const out = &bits(row * words);
    for (std::size_t w = 0; w < words; ++w) {
      const int count = std::min(64, rows.nx - static_cast<int>(64 * w));
      std::uint64_t word = 0;
      for (int i = 0; i < count; ++i) word |= std::uint64_t(test(in[i])) << i;
      out[w] = word;
      in += count;
    }
  });
  return bits;
}

/// Whether a value is above a limit, exactly: whole numbers of 64 bits aren't doubles.
template <class Value>
bool is_above(Value value, double limit) {
  if constexpr (std::is_integral_v<Value> && sizeof(Value) == 8) {
    if (std::isnan(limit)) return false;
    if (limit < static_cast<double>(std::numeric_limits<Value>::min())) return true;
    if (limit >= std::ldexp(1.0, std::numeric_limits<Value>::digits)) return false;
    return value > static_cast<Value>(std::floor(limit));
  } else {
    return static_cast<double>(value) > limit;
  }
}

/// The cubes of voxels whose values are above, or finite.
Grid grid_of(const VoxelRows& rows, const PointArray& scalars, const std::optional<double>& above) {
  const std::array<Id, 3> points = {rows.nx, rows.ny, rows.nz};
  const auto decide = [&](const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if (above) return Grid(points, mark(rows, values, [limit = *above](Value x) { return is_above(x, limit); }));
    if constexpr (std::is_floating_point_v<Value>) {
      return Grid(points, mark(rows, values, [](Value x) { return std::isfinite(x); }));
    } else {
      return Grid(points);
    }
  };
  return std::visit(decide, scalars.values);
}

void refuse_none(const VoxelRows& rows, const PointArray& scalars, const std::optional<double>& above) {
  std::ostringstream message;
  message << "no " << (rows.is_plane() ? "four" : "eight") << " neighbouring voxels of '" << scalars.name
          << "' are all ";
  above ? message << "above " << *above : message << "finite";
  throw Error(message.str());
}

/// Calls `body(vertex, voxel)` for every vertex with its place in the image.
template <class Body>
void for_each_vertex(const Grid& grid, const Body& body) {
  const auto [nx, ny, nz] = grid.points();
  parallel_for("GALE::for_each_voxel", Host(), Offset(ny) * nz, [&, width = nx](Offset row) {
    const Id at = static_cast<Id>(row);
    grid.for_each_vertex(at, at + 1,
                         [&](Id, Id x, Id vertex) { body(vertex, static_cast<std::size_t>(row) * width + x); });
  });
}

/// Two axes of the image along its plane, or all three.
std::vector<int> axes_of(const Image& image) {
  std::vector<int> axes;
  for (int d = 0; d < 3; ++d) {
    if (image.dimensions[d] > 1) axes.push_back(d);
  }
  return axes;
}

/// How far out the voxels may lie along any axis. Throws `Error` where that is no number.
double reach_of(const Image& image) {
  double farthest = 0;
  for (const auto& row : image.index_to_physical) {
    double reach = std::abs(row[3]);
    for (int d = 0; d < 3; ++d) reach += std::abs(row[d]) * image.dimensions[d];
    if (!std::isfinite(reach)) refuse("the image has voxels whose coordinates are not finite");
    farthest = std::max(farthest, reach);
  }
  return farthest;
}

/// Whether float would round coordinates by more than some hundredth of the shortest step between voxels.
bool needs_double(const Image& image, double farthest) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d) {
    double square = 0;
    for (const auto& row : image.index_to_physical) square += row[d] * row[d];
    if (image.dimensions[d] > 1) shortest = std::min(shortest, std::sqrt(square));
  }
  return farthest > shortest * 131072 || farthest > std::numeric_limits<float>::max();  // 2^17 of float's 2^24
}

template <class Coordinate>
Dataset::Points<Coordinate> make_points(const Grid& grid, const Image& image) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", grid.vertices());
  const std::vector<int> axes = axes_of(image);
  const std::size_t nx = grid.points()[0], ny = grid.points()[1];
  for_each_vertex(grid, [&](Id vertex, std::size_t voxel) {
    double place[3] = {0, 0, 0};
    place[axes[0]] = static_cast<double>(voxel % nx);
    place[axes[1]] = static_cast<double>(voxel / nx % ny);
    if (axes.size() == 3) place[2] = static_cast<double>(voxel / nx / ny);
    for (int d = 0; d < 3; ++d) {
      const auto& m = image.index_to_physical[d];
      points(vertex, d) = static_cast<Coordinate>(m[0] * place[0] + m[1] * place[1] + m[2] * place[2] + m[3]);
    }
  });
  return points;
}

PointArray array_at_vertices(const Grid& grid, PointArray&& array) {
  if (grid.is_whole()) return std::move(array);
  const std::size_t width = array.components;
  const auto compact = [&](const auto& from) -> PointArray::Values {
    std::decay_t<decltype(from)> to(grid.vertices() * width);
    for_each_vertex(grid, [&](Id vertex, std::size_t voxel) {
      for (std::size_t c = 0; c < width; ++c) to[vertex * width + c] = from[voxel * width + c];
    });
    return to;
  };
  PointArray made = {std::move(array.name), array.components, std::visit(compact, array.values)};
  array.values = {};  // frees them before the next, larger parts
  return made;
}

}  // namespace

Dataset split_voxels(Image image, std::optional<double> above, GridCells cells) {
  const auto [nx, ny, nz] = image.dimensions;
  const std::vector<int> axes = axes_of(image);
  if (axes.size() < 2)
    refuse("the image has ", nx, " x ", ny, " x ", nz, " voxels: it needs at least 2 in two directions");
  const VoxelRows rows{image.dimensions[axes[0]], image.dimensions[axes[1]],
                       axes.size() == 3 ? image.dimensions[axes[2]] : 1};
  const std::size_t voxels = rows.begin(rows.count());
  for (const PointArray& array : image.arrays) {
    if (point_count(array) != voxels)
      refuse("the array '", array.name, "' has ", point_count(array), " rows for ", voxels, " voxels");
  }
  const double farthest = reach_of(image);
  Dataset dataset;
  dataset.grid = grid_of(rows, image.arrays.front(), above);
  const Grid& grid = *dataset.grid;
  if (grid.cubes() == 0) refuse_none(rows, image.arrays.front(), above);
  dataset.notices = std::move(image.notices);
  for (PointArray& array : image.arrays) dataset.arrays.push_back(array_at_vertices(grid, std::move(array)));
  if (cells == GridCells::computed_alone) return dataset;
  if (needs_double(image, farthest)) {
    dataset.points = make_points<double>(grid, image);
  } else {
    dataset.points = make_points<float>(grid, image);
  }
  if (cells == GridCells::written) write_out_cells(dataset);
  return dataset;
}

}  // namespace gale::io
