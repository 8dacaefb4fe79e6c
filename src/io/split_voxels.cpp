#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
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

/// One byte a voxel, not initialized, so that the threads that fill it touch it first.
using Flags = std::unique_ptr<std::uint8_t[]>;

Flags make_flags(std::size_t count) { return Flags(new std::uint8_t[count]); }

/// The image as rows of voxels along x; row (y, z) is number z*ny + y. Of a plane the two axes along it are x and y,
/// which doesn't change the order of its voxels, and cubes are squares.
struct Rows {
  int nx, ny, nz;

  bool is_plane() const { return nz == 1; }

  Offset count() const { return Offset(ny) * nz; }
  std::size_t begin(Offset row) const { return std::size_t(row) * nx; }
  std::size_t voxels() const { return begin(count()); }
  int y(Offset row) const { return static_cast<int>(row % ny); }
  int z(Offset row) const { return static_cast<int>(row / ny); }
};

/// The rest of the image: the cubes and the voxels that they use, and how many come before each row (with the total
/// at the end).
struct Kept {
  Rows rows;
  Flags cube;  ///< by the cube's lowest corner
  Flags voxel;
  std::vector<Offset> cube_begin, voxel_begin;
};

Flags mark_inside(const Rows& rows, const PointArray::Values& values, const std::optional<double>& above) {
  Flags inside = make_flags(rows.voxels());
  const auto mark = [&](const auto& v, auto test) {
    parallel_for("GALE::mark_inside", Host(), rows.count(), [&](Offset row) {
      const auto* in = &v[rows.begin(row)];
      std::uint8_t* out = &inside[rows.begin(row)];
      for (int x = 0, nx = rows.nx; x < nx; ++x) out[x] = test(in[x]);
    });
  };
  const auto decide = [&](const auto& v) {
    using Value = typename std::decay_t<decltype(v)>::value_type;
    if (above) {
      mark(v, [limit = *above](Value x) { return static_cast<double>(x) > limit; });
    } else if constexpr (std::is_floating_point_v<Value>) {
      mark(v, [](Value x) { return std::isfinite(x); });
    } else {
      mark(v, [](Value) { return true; });
    }
  };
  std::visit(decide, values);
  return inside;
}

Flags mark_cubes(const Rows& rows, const Flags& inside) {
  Flags cube = make_flags(rows.voxels());
  parallel_for("GALE::mark_cubes", Host(), rows.count(), [&](Offset row) {
    std::uint8_t* out = &cube[rows.begin(row)];
    if (rows.y(row) + 1 == rows.ny || (!rows.is_plane() && rows.z(row) + 1 == rows.nz)) {
      std::fill_n(out, rows.nx, std::uint8_t(0));
      return;
    }
    const std::uint8_t* a = &inside[rows.begin(row)];
    const std::uint8_t* b = &inside[rows.begin(row + 1)];
    const std::uint8_t* c = rows.is_plane() ? a : &inside[rows.begin(row + rows.ny)];
    const std::uint8_t* d = rows.is_plane() ? b : &inside[rows.begin(row + rows.ny + 1)];
    for (int x = 0; x + 1 < rows.nx; ++x)
      out[x] = a[x] & b[x] & c[x] & d[x] & a[x + 1] & b[x + 1] & c[x + 1] & d[x + 1];
    out[rows.nx - 1] = 0;
  });
  return cube;
}

/// Overwrites `voxel` with 1 for the corners of cubes, 0 for the others.
void mark_corners(const Rows& rows, const Flags& cube, Flags& voxel) {
  const std::vector<std::uint8_t> none(rows.nx, 0);
  parallel_for("GALE::mark_corners", Host(), rows.count(), [&](Offset row) {
    const bool has_y = rows.y(row) > 0, has_z = rows.z(row) > 0;
    const auto cubes_of = [&](bool exists, Offset r) { return exists ? &cube[rows.begin(r)] : none.data(); };
    const std::uint8_t* a = cubes_of(true, row);
    const std::uint8_t* b = cubes_of(has_y, row - 1);
    const std::uint8_t* c = cubes_of(has_z, row - rows.ny);
    const std::uint8_t* d = cubes_of(has_y && has_z, row - rows.ny - 1);
    std::uint8_t* out = &voxel[rows.begin(row)];
    out[0] = a[0] | b[0] | c[0] | d[0];
    for (int x = 1; x < rows.nx; ++x) out[x] = a[x] | b[x] | c[x] | d[x] | a[x - 1] | b[x - 1] | c[x - 1] | d[x - 1];
  });
}

std::vector<Offset> count_before(const Rows& rows, const Flags& flags) {
  std::vector<Offset> begin(rows.count() + 1, 0);
  parallel_for("GALE::count_flags", Host(), rows.count(), [&](Offset row) {
    const std::uint8_t* flag = &flags[rows.begin(row)];
    begin[row + 1] = std::accumulate(flag, flag + rows.nx, Offset(0));
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

Kept keep(const Rows& rows, const PointArray& scalars, const std::optional<double>& above) {
  Kept kept;
  kept.rows = rows;
  kept.voxel = mark_inside(rows, scalars.values, above);
  kept.cube = mark_cubes(rows, kept.voxel);
  mark_corners(rows, kept.cube, kept.voxel);
  kept.cube_begin = count_before(rows, kept.cube);
  kept.voxel_begin = count_before(rows, kept.voxel);
  return kept;
}

void check(const Kept& kept, const PointArray& scalars, const std::optional<double>& above) {
  if (kept.cube_begin.back() == 0) {
    std::ostringstream message;
    message << "no " << (kept.rows.is_plane() ? "four" : "eight") << " neighbouring voxels of '" << scalars.name
            << "' are all ";
    above ? message << "above " << *above : message << "finite";
    throw Error(message.str());
  }
  const auto vertices = static_cast<double>(kept.voxel_begin.back()),
             cubes = static_cast<double>(kept.cube_begin.back());
  detail::require_ids_for("the voxels make", vertices, "vertices");
  if (kept.rows.is_plane()) {
    detail::require_ids_for("the voxels make", cubes * 2, "triangles");
  } else {
    detail::require_ids_for("the voxels make", cubes * detail::tetrahedra_per_cube, "tetrahedra");
  }
}

/// Calls `body(id, voxel)` for every kept voxel with its new id and its place in the image.
template <class Body>
void for_each_kept(const Kept& kept, const Body& body) {
  parallel_for("GALE::for_each_kept", Host(), kept.rows.count(), [&](Offset row) {
    Offset id = kept.voxel_begin[row];
    if (id == kept.voxel_begin[row + 1]) return;
    const std::size_t begin = kept.rows.begin(row), end = kept.rows.begin(row + 1);
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
      if (kept.voxel[voxel]) body(id++, voxel);
    }
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

/// Whether float would round coordinates by more than some hundredth of the shortest step between voxels.
bool needs_double(const Image& image) {
  double farthest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const auto& row : image.index_to_physical) {
    double reach = std::abs(row[3]);
    for (int d = 0; d < 3; ++d) reach += std::abs(row[d]) * image.dimensions[d];
    farthest = std::max(farthest, reach);
  }
  for (int d = 0; d < 3; ++d) {
    double square = 0;
    for (const auto& row : image.index_to_physical) square += row[d] * row[d];
    if (image.dimensions[d] > 1) shortest = std::min(shortest, std::sqrt(square));
  }
  return farthest > shortest * 131072;  // 2^17 of float's 2^24
}

template <class Coordinate>
Dataset::Points<Coordinate> make_points(const Kept& kept, const Image& image) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", kept.voxel_begin.back());
  const std::vector<int> axes = axes_of(image);
  for_each_kept(kept, [&](Offset id, std::size_t voxel) {
    const std::size_t row = voxel / kept.rows.nx;
    double place[3] = {0, 0, 0};
    place[axes[0]] = static_cast<double>(voxel % kept.rows.nx);
    place[axes[1]] = kept.rows.y(row);
    if (axes.size() == 3) place[2] = kept.rows.z(row);
    for (int d = 0; d < 3; ++d) {
      const auto& m = image.index_to_physical[d];
      points(id, d) = static_cast<Coordinate>(m[0] * place[0] + m[1] * place[1] + m[2] * place[2] + m[3]);
    }
  });
  return points;
}

PointArray make_array(const Kept& kept, const PointArray& array) {
  const std::size_t width = array.components;
  const auto compact = [&](const auto& from) -> PointArray::Values {
    std::decay_t<decltype(from)> to(kept.voxel_begin.back() * width);
    for_each_kept(kept, [&](Offset id, std::size_t voxel) {
      for (std::size_t c = 0; c < width; ++c) to[id * width + c] = from[voxel * width + c];
    });
    return to;
  };
  return {array.name, array.components, std::visit(compact, array.values)};
}

auto make_tetrahedra(const Kept& kept) {
  const Rows& rows = kept.rows;
  const auto tetrahedra =
      allocate<decltype(Dataset::tetrahedra)>("GALE::tetrahedra", kept.cube_begin.back() * detail::tetrahedra_per_cube);
  parallel_for("GALE::make_tetrahedra", Host(), rows.count(), [&](Offset row) {
    if (kept.cube_begin[row] == kept.cube_begin[row + 1]) return;
    std::size_t t = kept.cube_begin[row] * detail::tetrahedra_per_cube;
    // The four rows of voxels around this row of cubes; in each, the id of the first kept voxel at or after x.
    const Offset around[4] = {row, row + 1, row + rows.ny, row + rows.ny + 1};
    const std::uint8_t* voxel[4];
    Id next[4];
    for (int k = 0; k < 4; ++k) {
      voxel[k] = &kept.voxel[rows.begin(around[k])];
      next[k] = static_cast<Id>(kept.voxel_begin[around[k]]);
    }
    const std::uint8_t* cube = &kept.cube[rows.begin(row)];
    for (int x = 0; x + 1 < rows.nx; ++x) {
      if (cube[x]) {
        for (const auto& walk : detail::freudenthal) {
          for (int k = 0; k < 4; ++k) tetrahedra(t, k) = next[walk[k] >> 1] + (walk[k] & 1);
          ++t;
        }
      }
      for (int k = 0; k < 4; ++k) next[k] += voxel[k][x];
    }
  });
  return tetrahedra;
}

auto make_triangles(const Kept& kept) {
  const Rows& rows = kept.rows;
  const auto triangles = allocate<decltype(Dataset::triangles)>("GALE::triangles", kept.cube_begin.back() * 2);
  parallel_for("GALE::make_triangles", Host(), rows.count(), [&](Offset row) {
    if (kept.cube_begin[row] == kept.cube_begin[row + 1]) return;
    std::size_t t = kept.cube_begin[row] * 2;
    const std::uint8_t *low = &kept.voxel[rows.begin(row)], *high = &kept.voxel[rows.begin(row + 1)];
    Id a = static_cast<Id>(kept.voxel_begin[row]), b = static_cast<Id>(kept.voxel_begin[row + 1]);
    const std::uint8_t* square = &kept.cube[rows.begin(row)];
    for (int x = 0; x + 1 < rows.nx; ++x) {
      if (square[x]) {
        const Id corners[2][3] = {{a, a + 1, b + 1}, {a, b, b + 1}};
        for (const auto& triangle : corners) {
          for (int k = 0; k < 3; ++k) triangles(t, k) = triangle[k];
          ++t;
        }
      }
      a += low[x];
      b += high[x];
    }
  });
  return triangles;
}

}  // namespace

Dataset split_voxels(Image image, std::optional<double> above) {
  const auto [nx, ny, nz] = image.dimensions;
  const std::vector<int> axes = axes_of(image);
  if (axes.size() < 2)
    refuse("the image has ", nx, " x ", ny, " x ", nz, " voxels: it needs at least 2 in two directions");
  const Rows rows{image.dimensions[axes[0]], image.dimensions[axes[1]],
                  axes.size() == 3 ? image.dimensions[axes[2]] : 1};
  const Kept kept = keep(rows, image.arrays.front(), above);
  check(kept, image.arrays.front(), above);

  Dataset dataset;
  dataset.notices = std::move(image.notices);
  for (PointArray& array : image.arrays) {
    dataset.arrays.push_back(make_array(kept, array));
    array.values = {};  // frees them before the next, larger parts
  }
  if (needs_double(image)) {
    dataset.points = make_points<double>(kept, image);
  } else {
    dataset.points = make_points<float>(kept, image);
  }
  if (rows.is_plane()) {
    dataset.triangles = make_triangles(kept);
  } else {
    dataset.tetrahedra = make_tetrahedra(kept);
  }
  return dataset;
}

}  // namespace gale::io
