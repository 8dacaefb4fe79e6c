#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/base/transfer.hpp>
#include <gale/base/worker_or_host.hpp>
#include <gale/mesh/octree_leaves.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale {

namespace {

/// The cube that the octree halves: its side is a power of two, so that points on an integer grid meet cell borders
/// exactly.
struct Cube {
  double origin[3];
  double cells_per_unit;  ///< smallest cells along a unit of length
};

template <class Coordinate, class Space>
Cube bounding_cube(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points) {
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

template <class Coordinate, class Space>
Array<std::uint64_t, MemoryOf<Space>> morton_codes(const Space& space,
                                                   const Points<Coordinate, MemoryOf<Space>>& points,
                                                   const Cube& cube) {
  const auto codes = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::morton_codes", points.extent(0));
  parallel_for(
      "GALE::morton_codes", space, points.extent(0), KOKKOS_LAMBDA(Offset i) {
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

Mirrored<Id> vertex_begin_of(const std::vector<Id>& begin) {
  const auto ids = allocate<Array<Id, HostMemory>>("GALE::vertex_begin", begin.size());
  std::copy(begin.begin(), begin.end(), ids.data());
  return ids;
}

template <class Coordinate, class Space>
Segmentation octree_in(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points, int capacity) {
  const auto count = static_cast<Id>(points.extent(0));
  const auto codes = morton_codes<Coordinate>(space, points, bounding_cube<Coordinate>(space, points));
  const auto vertex_input = iota("GALE::vertex_input", space, count);
  stable_sort_by_key(space, codes, vertex_input);
  const auto leaves = detail::octree_leaves(space, codes, capacity);
  space.fence();
  return {vertex_input, vertex_begin_of(detail::merge_leaves(leaves, count, capacity))};
}

/// Sorts `keys`, and says where each stood. Overwrites them.
template <class Space>
Mirrored<Id> sort_labels(const Space& space, const Array<std::uint64_t, HostMemory>& keys) {
  const auto sorted = in_memory<MemoryOf<Space>>(keys);
  const auto vertex_input = iota("GALE::vertex_input", space, keys.extent(0));
  stable_sort_by_key(space, sorted, vertex_input);
  const auto back = on_host(sorted);
  if (back.data() != keys.data()) Kokkos::deep_copy(keys, back);
  space.fence();
  return vertex_input;
}

}  // namespace

template <class Coordinate, class Memory>
Segmentation octree_segmentation(const Points<Coordinate, Memory>& given, int capacity) {
  if (capacity < 1) throw Error("a segment's capacity must be at least 1 vertex, not " + std::to_string(capacity));
  require_ids("vertices", static_cast<Offset>(given.extent(0)));
  if (given.extent(0) == 0) return {iota("GALE::vertex_input", HostSpace(), 0), vertex_begin_of({0})};
  return in_worker_or_host_space(true, [&](const auto& space) {
    using Here = MemoryOf<std::decay_t<decltype(space)>>;
    return octree_in<Coordinate>(space, in_memory<Here>(given), capacity);
  });
}

Segmentation given_segmentation(const Array<const std::int64_t, HostMemory>& labels) {
  require_ids("vertices", static_cast<Offset>(labels.extent(0)));
  const auto count = static_cast<Id>(labels.extent(0));
  const auto keys = allocate<Array<std::uint64_t, HostMemory>>("GALE::labels", count);
  for (Id i = 0; i < count; ++i) keys(i) = static_cast<std::uint64_t>(labels(i)) ^ (std::uint64_t(1) << 63);
  const auto vertex_input = in_worker_or_host_space(true, [&](const auto& space) { return sort_labels(space, keys); });
  std::vector<Id> begin;
  for (Id i = 0; i < count; ++i) {
    if (i == 0 || keys(i) != keys(i - 1)) begin.push_back(i);
  }
  begin.push_back(count);
  return {vertex_input, vertex_begin_of(begin)};
}

#define GALE_INSTANTIATE(Coordinate, Memory) \
  template GALE_EXPORT Segmentation octree_segmentation(const Points<Coordinate, Memory>&, int)
GALE_INSTANTIATE(float, HostMemory);
GALE_INSTANTIATE(double, HostMemory);
#if defined(KOKKOS_ENABLE_CUDA)
GALE_INSTANTIATE(float, WorkerMemory);
GALE_INSTANTIATE(double, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

}  // namespace gale
