#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/morton_codes.hpp>

namespace gale::detail {

namespace {

/// Two zero bits between any two of the lowest 21.
KOKKOS_FUNCTION std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

}  // namespace

template <class Coordinate, class Space>
void require_finite(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points) {
  const Offset count = points.extent(0);
  const Offset bad = reduce_min(
      "GALE::finite_points", space, count, count, KOKKOS_LAMBDA(Offset i) {
        const double x = points(i, 0), y = points(i, 1), z = points(i, 2);
        return (x - x) + (y - y) + (z - z) == 0 ? count : i;
      });
  if (bad < count) throw Error("point " + std::to_string(bad) + " has a coordinate that is not finite");
}

template <class Coordinate, class Space>
Box bounding_box(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points) {
  require_finite<Coordinate>(space, points);
  const Offset count = points.extent(0);
  Box box{};
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    box.low[axis] = reduce_min(
        "GALE::lowest_point", space, count, infinity, KOKKOS_LAMBDA(Offset i) { return double(points(i, axis)); });
    box.high[axis] = -reduce_min(
        "GALE::highest_point", space, count, infinity, KOKKOS_LAMBDA(Offset i) { return -double(points(i, axis)); });
  }
  return box;
}

Cube cube_around(const Box& box) {
  Cube cube{};
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    cube.origin[axis] = box.low[axis];
    extent = std::max(extent, box.high[axis] - box.low[axis]);
  }
  int exponent = 0;
  std::frexp(extent, &exponent);  // extent < 2^exponent
  cube.cells_per_unit = extent > 0 ? std::ldexp(1.0, morton_levels - exponent) : 0.0;
  return cube;
}

template <class Coordinate, class Space>
Array<std::uint64_t, MemoryOf<Space>> morton_codes(const Space& space,
                                                   const Points<Coordinate, MemoryOf<Space>>& points,
                                                   const Cube& cube) {
  const auto codes = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::morton_codes", points.extent(0));
  parallel_for(
      "GALE::morton_codes", space, points.extent(0), KOKKOS_LAMBDA(Offset i) {
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
          constexpr double last = (1 << morton_levels) - 1;
          const double cell = (double(points(i, axis)) - cube.origin[axis]) * cube.cells_per_unit;
          code |= spread_bits(static_cast<std::uint64_t>(cell < last ? cell : last)) << (2 - axis);
        }
        codes(i) = code;
      });
  return codes;
}

#define GALE_INSTANTIATE_FOR(Coordinate, Space)                                                                   \
  template GALE_EXPORT void require_finite<Coordinate>(const Space&, const Points<Coordinate, MemoryOf<Space>>&); \
  template GALE_EXPORT Box bounding_box<Coordinate>(const Space&, const Points<Coordinate, MemoryOf<Space>>&);    \
  template GALE_EXPORT Array<std::uint64_t, MemoryOf<Space>> morton_codes<Coordinate>(                            \
      const Space&, const Points<Coordinate, MemoryOf<Space>>&, const Cube&)
#define GALE_INSTANTIATE(Space)       \
  GALE_INSTANTIATE_FOR(float, Space); \
  GALE_INSTANTIATE_FOR(double, Space)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_FOR

}  // namespace gale::detail
