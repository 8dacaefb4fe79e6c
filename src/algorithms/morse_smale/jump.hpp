#pragma once

#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// What stands for the end of a path at the simplex with a place, e.g. among the critical ones.
KOKKOS_FORCEINLINE_FUNCTION constexpr Id end_at(Id place) { return -2 - place; }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id place_of_end(Id end) { return -2 - end; }

/// What stands for the end of a path that leaves through the surface: the place no_id.
inline constexpr Id path_outside = end_at(no_id);

/// Begins the paths of `with_ends`.
template <class Memory>
struct BeginPath {
  Array<const Id, Memory> from;
  Array<Id, Memory> next;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id successor = from(i);
    next(i) = successor < no_id ? path_outside : successor;
  }
};

/// Ends those that lead to one of the places.
template <class Memory>
struct EndPath {
  Array<const Id, Memory> places;
  Array<Id, Memory> next;

  KOKKOS_FUNCTION void operator()(Offset i) const { next(places(i)) = end_at(static_cast<Id>(i)); }
};

/// Some jumps on a path, as a device takes them; 1 if it goes on.
template <class Memory>
struct JumpAhead {
  static constexpr int jumps_a_pass = 4;
  Array<Id, Memory> next;

  KOKKOS_FUNCTION int operator()(Offset i) const {
    Id at = atomic_read(&next(i));
    if (at < 0) return 0;
    for (int k = 0; k < jumps_a_pass && at >= 0; ++k) at = atomic_read(&next(at));
    atomic_write(&next(i), at);
    return at >= 0 ? 1 : 0;
  }
};

/// Reads where a simplex' path ends.
template <class Memory>
struct EndAt {
  Array<const Id, Memory> ends;
  KOKKOS_FUNCTION Id operator()(Id simplex) const { return place_of_end(ends(simplex)); }
};

/// The places at which the paths of some simplices end; no_id for those that leave through the surface.
template <class Space>
std::vector<Id> ends_of(const Space& space, const Array<const Id, MemoryOf<Space>>& ends,
                        const std::vector<Id>& simplices) {
  return results_at("GALE::ends_of", space, simplices, EndAt<MemoryOf<Space>>{ends});
}

/// Successors in some memory. Where they lie on the host, a copy on the device lives as long as what is returned.
template <class Memory>
Array<const Id, Memory> successors_in(const Mirrored<Id>& successors) {
  if (successors.on_device()) return successors.in<Memory>();
  return in_memory<Memory>(successors.in<HostMemory>());
}

/// A copy of successors in a space's memory in which those of `ends` lead to their places there, and those that leave
/// through the surface to `path_outside`.
template <class Space>
Array<Id, MemoryOf<Space>> with_ends(const Space& space, const Mirrored<Id>& successors, const std::vector<Id>& ends) {
  const auto next = allocate<Array<Id, MemoryOf<Space>>>("GALE::next_on_path", successors.size());
  const auto from = successors_in<MemoryOf<Space>>(successors);
  parallel_for("GALE::begin_paths", space, from.extent(0), BeginPath<MemoryOf<Space>>{from, next});
  const auto places = in_memory<MemoryOf<Space>>(ends);
  parallel_for("GALE::end_paths", space, places.extent(0), EndPath<MemoryOf<Space>>{places, next});
  return next;
}

/// Follows each path to its end, and has all entries on the way lead there. Threads may do that to the same entries at
/// the same time: these only get closer to their ends.
inline void follow_to_ends(const Array<Id, HostMemory>& next) {
  parallel_for("GALE::follow_to_ends", HostExecutionSpace(), next.extent(0), [&](Offset i) {
    Id end = atomic_read(&next(i));
    while (end >= 0) end = atomic_read(&next(end));
    Id at = static_cast<Id>(i);
    for (Id to = atomic_read(&next(at)); to >= 0; at = to, to = atomic_read(&next(at))) atomic_write(&next(at), end);
  });
}

/// Afterwards each entry is the end of its path: below 0. On a device each jumps over the entry that it leads to, on
/// the host it is followed.
template <class Space>
void jump(const Space& space, const Array<Id, MemoryOf<Space>>& next) {
  if constexpr (is_device<Space>) {
    while (reduce_sum("GALE::jump", space, next.extent(0), JumpAhead<MemoryOf<Space>>{next}) != 0) {
    }
  } else {
    follow_to_ends(next);
  }
}

}  // namespace gale::detail
