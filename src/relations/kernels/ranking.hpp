#pragma once

#include <gale/base/ordered.hpp>
#include <gale/base/team.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// Up to so many entries a warp orders by counting, for each, those that are less; more, by a heap.
inline constexpr Id counting_limit = 512;

KOKKOS_FORCEINLINE_FUNCTION Id count_less(const Id* ids, Id count, Id than) {
  Id less = 0;
  for (Id i = 0; i < count; ++i) less += ids[i] < than ? 1 : 0;
  return less;
}

/// Place of `id` in an ascending row that has it.
KOKKOS_FORCEINLINE_FUNCTION Id place_in(const Id* row, Id count, Id id) {
  return bisect(Id(0), count, [=](Id i) { return row[i] < id; });
}

KOKKOS_FORCEINLINE_FUNCTION void heap_sort(Id* ids, Id count) {
  gale::heap_sort(
      count, [=](Id i) { return ids[i]; }, [=](Id i, Id id) { ids[i] = id; });
}

/// Inside for_warps: calls visit(i, id, place) with the place in ascending order that each of the distinct `ids` has; i
/// counts them in the order in which they then stand. More than `counting_limit` are put in order first.
template <class Team, class Visit>
KOKKOS_FORCEINLINE_FUNCTION void rank(const Team& team, Id* ids, Id count, const Visit& visit) {
  if (count > counting_limit) {
    team::once_per_warp(team, [&] { heap_sort(ids, count); });
    team::warp_barrier(team);
    team::for_lanes(team, count, [&](Id i) { visit(i, ids[i], i); });
  } else {
    team::for_lanes(team, count, [&](Id i) { visit(i, ids[i], count_less(ids, count, ids[i])); });
  }
}

}  // namespace gale::detail
