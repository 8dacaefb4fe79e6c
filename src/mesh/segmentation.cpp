#include <cmath>
#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/octree_leaves.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale {

namespace {

using Codes = Array<std::uint64_t, WorkerMemory>;
using Ids = Array<Id, WorkerMemory>;

/// The cube that the octree halves: its side is a power of two, so that points on an integer grid meet cell borders
/// exactly.
struct Cube {
  double origin[3];
  double cells_per_unit;  ///< smallest cells along a unit of length
};

template <class Coordinate>
Cube bounding_cube(const Points<Coordinate, WorkerMemory>& points) {
  const WorkerSpace space;
  const Offset count = points.extent(0);
  const Offset bad = reduce_min(
      "GALE::finite_points", space, count, count, KOKKOS_LAMBDA(Offset i) {
        const double x = points(i, 0), y = points(i, 1), z = points(i, 2);
        return (x - x) + (y - y) + (z - z) == 0 ? count : i;
      });
  if (bad < count) throw Error("point " + std::to_string(bad) + " has a coordinate that is not finite");
  Cube cube{};
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double low = reduce_min(
        "GALE::lowest_point", space, count, infinity, KOKKOS_LAMBDA(Offset i) { return double(points(i, axis)); });
    const double high = -reduce_min(
        "GALE::highest_point", space, count, infinity, KOKKOS_LAMBDA(Offset i) { return -double(points(i, axis)); });
    cube.origin[axis] = low;
    extent = std::max(extent, high - low);
  }
  int exponent = 0;
  std::frexp(extent, &exponent);  // extent < 2^exponent
  cube.cells_per_unit = extent > 0 ? std::ldexp(1.0, detail::morton_levels - exponent) : 0.0;
  return cube;
}

/// Two zero bits between any two of the lowest 21.
KOKKOS_FUNCTION std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

template <class Coordinate>
Codes morton_codes(const Points<Coordinate, WorkerMemory>& points, const Cube& cube) {
  const auto codes = allocate<Codes>("GALE::morton_codes", points.extent(0));
  parallel_for(
      "GALE::morton_codes", WorkerSpace(), points.extent(0), KOKKOS_LAMBDA(Offset i) {
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
          constexpr double last = (1 << detail::morton_levels) - 1;
          const double cell = (double(points(i, axis)) - cube.origin[axis]) * cube.cells_per_unit;
          code |= spread(static_cast<std::uint64_t>(cell < last ? cell : last)) << (2 - axis);
        }
        codes(i) = code;
      });
  return codes;
}

Ids iota(Offset count) {
  const auto ids = allocate<Ids>("GALE::vertex_input", count);
  parallel_for(
      "GALE::iota", WorkerSpace(), count, KOKKOS_LAMBDA(Offset i) { ids(i) = static_cast<Id>(i); });
  return ids;
}

Ids to_workers(const std::vector<Id>& values, const char* label) {
  const auto ids = allocate<Ids>(label, values.size());
  Kokkos::deep_copy(ids, Kokkos::View<const Id*, HostMemory, Kokkos::MemoryUnmanaged>(values.data(), values.size()));
  return ids;
}

}  // namespace

template <class Coordinate, class Memory>
Segmentation octree_segmentation(const Points<Coordinate, Memory>& given, int capacity) {
  if (capacity < 1) throw Error("a segment's capacity must be at least 1 vertex, not " + std::to_string(capacity));
  require_ids("vertices", static_cast<Offset>(given.extent(0)));
  const auto count = static_cast<Id>(given.extent(0));
  Segmentation result;
  if (count == 0) {
    result.vertex_input = Ids("GALE::vertex_input", 0);
    result.vertex_begin = Ids("GALE::vertex_begin", 1);
    return result;
  }
  const Points<Coordinate, WorkerMemory> points = on_worker(given);
  const auto codes = morton_codes(points, bounding_cube(points));
  result.vertex_input = iota(count);
  stable_sort_by_key(codes, result.vertex_input);
  const auto leaves = detail::octree_leaves(codes, capacity);
  result.vertex_begin = to_workers(detail::merge_leaves(leaves, count, capacity), "GALE::vertex_begin");
  return result;
}

Segmentation given_segmentation(const Array<const std::int64_t, HostMemory>& labels) {
  require_ids("vertices", static_cast<Offset>(labels.extent(0)));
  const auto count = static_cast<Id>(labels.extent(0));
  const auto keys_on_host = allocate<Array<std::uint64_t, HostMemory>>("GALE::labels", count);
  for (Id i = 0; i < count; ++i) keys_on_host(i) = static_cast<std::uint64_t>(labels(i)) ^ (std::uint64_t(1) << 63);
  const Codes keys = on_worker(keys_on_host);
  Segmentation result;
  result.vertex_input = iota(count);
  stable_sort_by_key(keys, result.vertex_input);
  const auto sorted = on_host(keys);
  std::vector<Id> begin;
  for (Id i = 0; i < count; ++i) {
    if (i == 0 || sorted(i) != sorted(i - 1)) begin.push_back(i);
  }
  begin.push_back(count);
  result.vertex_begin = to_workers(begin, "GALE::vertex_begin");
  return result;
}

#define GALE_INSTANTIATE(Coordinate, Memory) \
  template Segmentation octree_segmentation(const Points<Coordinate, Memory>&, int)
GALE_INSTANTIATE(float, HostMemory);
GALE_INSTANTIATE(double, HostMemory);
#if defined(KOKKOS_ENABLE_CUDA)
GALE_INSTANTIATE(float, WorkerMemory);
GALE_INSTANTIATE(double, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

}  // namespace gale
