#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
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

/// The image as rows of voxels along x; row (y, z) is number z*ny + y.
struct Rows {
  int nx, ny, nz;

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
    if (rows.y(row) + 1 == rows.ny || rows.z(row) + 1 == rows.nz) {
      std::fill_n(out, rows.nx, std::uint8_t(0));
      return;
    }
    const std::uint8_t* a = &inside[rows.begin(row)];
    const std::uint8_t* b = &inside[rows.begin(row + 1)];
    const std::uint8_t* c = &inside[rows.begin(row + rows.ny)];
    const std::uint8_t* d = &inside[rows.begin(row + rows.ny + 1)];
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
    message << "no eight neighbouring voxels of '" << scalars.name << "' are all ";
    above ? message << "above " << *above : message << "finite";
    throw Error(message.str());
  }
  const auto vertices = static_cast<double>(kept.voxel_begin.back()),
             cubes = static_cast<double>(kept.cube_begin.back());
  detail::require_ids_for("the voxels make", vertices, "vertices");
  detail::require_ids_for("the voxels make", cubes * detail::tetrahedra_per_cube, "tetrahedra");
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
    shortest = std::min(shortest, std::sqrt(square));
  }
  return farthest > shortest * 131072;  // 2^17 of float's 2^24
}

template <class Coordinate>
Dataset::Points<Coordinate> make_points(const Kept& kept, const Image& image) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", kept.voxel_begin.back());
  for_each_kept(kept, [&](Offset id, std::size_t voxel) {
    const std::size_t row = voxel / kept.rows.nx;
    const double i = static_cast<double>(voxel % kept.rows.nx), j = kept.rows.y(row), k = kept.rows.z(row);
    for (int d = 0; d < 3; ++d) {
      const auto& m = image.index_to_physical[d];
      points(id, d) = static_cast<Coordinate>(m[0] * i + m[1] * j + m[2] * k + m[3]);
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

std::string component_name(const PointArray& array, int component) {
  return array.name + "_" + std::to_string(component);
}

/// The array of that name, or the component of that name as a new array at the end. `arrays.end()` if there is neither.
auto find_or_extract(std::vector<PointArray>& arrays, const std::string& name) {
  const auto named = std::find_if(arrays.begin(), arrays.end(), [&](const PointArray& a) { return a.name == name; });
  if (named != arrays.end()) return named;
  for (const PointArray& array : arrays) {
    for (int c = 0; array.components > 1 && c < array.components; ++c) {
      if (component_name(array, c) != name) continue;
      PointArray component = extract_component(array, c);
      arrays.push_back(std::move(component));
      return std::prev(arrays.end());
    }
  }
  return arrays.end();
}

std::string names(const std::vector<PointArray>& arrays) {
  std::string list;
  for (const PointArray& array : arrays) list += (list.empty() ? "'" : ", '") + array.name + "'";
  return list;
}

}  // namespace

void select_scalars(Image& image, const std::string& name) {
  if (image.arrays.empty()) throw Error("the image has no scalars");
  const auto chosen = name.empty() ? image.arrays.begin() : find_or_extract(image.arrays, name);
  if (chosen == image.arrays.end()) refuse("the image has no array '", name, "', only ", names(image.arrays));
  if (chosen->components != 1)
    refuse("the array '", chosen->name, "' has ", chosen->components, " components: choose one of '",
           component_name(*chosen, 0), "' to '", component_name(*chosen, chosen->components - 1), "'");
  std::rotate(image.arrays.begin(), chosen, chosen + 1);
}

void rescale(Image& image, double slope, double intercept) {
  const bool changes =
      slope != 0 && std::isfinite(slope) && std::isfinite(intercept) && !(slope == 1 && intercept == 0);
  if (!changes) return;
  const auto scaled = [&](const auto& from) -> PointArray::Values {
    using From = typename std::decay_t<decltype(from)>::value_type;
    using To = std::conditional_t<(sizeof(From) < 4) || std::is_same_v<From, float>, float, double>;
    std::vector<To> to(from.size());
    std::transform(from.begin(), from.end(), to.begin(),
                   [&](From v) { return static_cast<To>(slope * v + intercept); });
    return to;
  };
  for (PointArray& array : image.arrays) array.values = std::visit(scaled, array.values);
}

void detail::require_ids_for(const std::string& these, double count, const std::string& of_what) {
  if (count <= std::numeric_limits<Id>::max()) return;
  std::ostringstream digits;
  digits << std::fixed << std::setprecision(0) << count;
  refuse(these, " ", digits.str(), " ", of_what, ", more than the ", std::numeric_limits<Id>::max(),
         " that 32-bit ids can number");
}

Dataset split_voxels(Image image, std::optional<double> above) {
  const auto [nx, ny, nz] = image.dimensions;
  if (nx < 2 || ny < 2 || nz < 2)
    refuse("the image has ", nx, " x ", ny, " x ", nz, " voxels: it needs at least 2 in each direction");
  const Kept kept = keep({nx, ny, nz}, image.arrays.front(), above);
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
  dataset.tetrahedra = make_tetrahedra(kept);
  return dataset;
}

}  // namespace gale::io
