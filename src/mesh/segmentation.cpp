#include <algorithm>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/octree.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale {

namespace {

Mirrored<Id> vertex_begin_of(const std::vector<Id>& begin) { return detail::array_of("GALE::vertex_begin", begin); }

template <class Coordinate, class Space>
Segmentation octree_in(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points, int capacity) {
  const auto count = static_cast<Id>(points.extent(0));
  const auto cube = detail::cube_around(detail::bounding_box<Coordinate>(space, points));
  const auto codes = detail::morton_codes<Coordinate>(space, points, cube);
  const auto vertex_input = stable_sort_places(space, "GALE::vertex_input", codes);
  const auto leaves = detail::octree_leaves(space, codes, capacity);
  space.fence();
  return {vertex_input, vertex_begin_of(detail::merge_leaves(leaves, count, capacity))};
}

/// Sorts `keys`, and says where each stood. Overwrites them.
template <class Space>
Mirrored<Id> sort_labels(const Space& space, const Array<std::uint64_t, HostMemory>& keys) {
  const auto sorted = in_memory<MemoryOf<Space>>(keys);
  const auto vertex_input = stable_sort_places(space, "GALE::vertex_input", sorted);
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
  if (given.extent(0) == 0) return {iota("GALE::vertex_input", HostExecutionSpace(), 0), vertex_begin_of({0})};
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
#if defined(GALE_HAS_DEVICE)
GALE_INSTANTIATE(float, WorkerMemory);
GALE_INSTANTIATE(double, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

}  // namespace gale
