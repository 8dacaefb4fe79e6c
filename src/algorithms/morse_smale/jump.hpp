#pragma once

#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// What stands for the end of a path at the simplex with a place, e.g. among the critical ones.
KOKKOS_FORCEINLINE_FUNCTION constexpr Id end_at(Id place) { return -2 - place; }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id place_of_end(Id end) { return -2 - end; }

/// What stands for the end of a path that leaves through the surface: the place no_id.
inline constexpr Id path_outside = -1;

/// A copy of successors in a space's memory in which those of `ends` lead to their places there, and those that leave
/// through the surface to `path_outside`.
template <class Space>
Array<Id, MemoryOf<Space>> with_ends(const Space& space, const Mirrored<Id>& successors, const std::vector<Id>& ends) {
  const auto next = allocate<Array<Id, MemoryOf<Space>>>("GALE::next_on_path", successors.size());
  // A copy for the device alone goes when this is done.
  Array<const Id, MemoryOf<Space>> from;
  if (successors.on_device()) {
    from = successors.in<MemoryOf<Space>>();
  } else {
    from = in_memory<MemoryOf<Space>>(successors.in<HostMemory>());
  }
  parallel_for(
      "GALE::begin_paths", space, from.extent(0), KOKKOS_LAMBDA(Offset i) {
        const Id successor = from(i);
        next(i) = successor < no_id ? path_outside : successor;
      });
  const auto places = in_memory<MemoryOf<Space>>(Array<const Id, HostMemory>(ends.data(), ends.size()));
  parallel_for(
      "GALE::end_paths", space, places.extent(0),
      KOKKOS_LAMBDA(Offset i) { next(places(i)) = end_at(static_cast<Id>(i)); });
  return next;
}

/// Pointer jumping: afterwards each entry is the end of its path: below 0. Entries that others jump over meanwhile only
/// get closer to their ends.
template <class Space>
void jump(const Space& space, const Array<Id, MemoryOf<Space>>& next) {
  constexpr int jumps_a_pass = 4;
  const Offset count = next.extent(0);
  while (true) {
    const Offset open = reduce_sum(
        "GALE::jump", space, count, KOKKOS_LAMBDA(Offset i) {
          Id at = atomic_read(&next(i));
          if (at < 0) return 0;
          for (int k = 0; k < jumps_a_pass && at >= 0; ++k) at = atomic_read(&next(at));
          atomic_write(&next(i), at);
          return at >= 0 ? 1 : 0;
        });
    if (open == 0) return;
  }
}

}  // namespace gale::detail
