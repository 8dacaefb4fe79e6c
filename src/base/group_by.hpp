#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/csr.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>

namespace gale {

namespace detail {

// Functors instead of lambdas: nvcc then takes a `visit_keys` that is a lambda of the host's, for loops on the host.

template <class Indices, class VisitKeys>
struct CountMembers {
  VisitKeys visit_keys;
  Indices counts;

  GALE_CALLS_ANY
  KOKKOS_FUNCTION void operator()(Offset item) const {
    using Index = typename Indices::value_type;
    visit_keys(static_cast<Id>(item), [&](Id key) { atomic_add(&counts(key), Index(1)); });
  }
};

template <class Indices, class Members, class VisitKeys>
struct FillGroups {
  VisitKeys visit_keys;
  Indices next;
  Members members;

  GALE_CALLS_ANY
  KOKKOS_FUNCTION void operator()(Offset item) const {
    using Index = typename Indices::value_type;
    visit_keys(static_cast<Id>(item),
               [&](Id key) { members(atomic_add(&next(key), Index(1))) = static_cast<Id>(item); });
  }
};

/// How the host groups: each part of the items counts and places by itself, without atomics, after the parts before it,
/// so that members ascend.
template <class Index, class VisitKeys>
Csr<Id, HostMemory, Index> group_by_parts(const std::string& label, Offset items, Offset keys, int parts,
                                          const VisitKeys& visit_keys) {
  const HostExecutionSpace space;
  const auto next = allocate<Array<Index, HostMemory>>(label, parts * keys);
  const auto next_of = [&](int part) { return next.data() + part * keys; };
  const auto for_keys = [&](const char* step, const auto& visit) {
    for_parts((label + step).c_str(), items, parts, [&](int part, Offset first, Offset last) {
      Index* const mine = next_of(part);
      for_range(first, last, [&](Offset item) {
        visit_keys(static_cast<Id>(item), [&](Id key) { visit(mine[key], static_cast<Id>(item)); });
      });
    });
  };
  fill((label + "_clear").c_str(), space, next, Index(0));
  for_keys("_count", [](Index& count, Id) { ++count; });
  const auto begin = allocate<Array<Index, HostMemory>>(label, keys + 1);
  const Index total = exclusive_scan((label + "_scan").c_str(), space, keys, begin, [&](Offset key) {
    Index sum = 0;
    for (int part = 0; part < parts; ++part) sum += next_of(part)[key];
    return sum;
  });
  parallel_for((label + "_place").c_str(), space, keys, [&](Offset key) {
    Index at = begin(key);
    for (int part = 0; part < parts; ++part) at += std::exchange(next_of(part)[key], at);
  });
  const auto members = allocate<Array<Id, HostMemory>>(label, total);
  Id* const all = members.data();
  for_keys("_fill", [all](Index& at, Id item) { all[at++] = item; });
  return {begin, members};
}

template <class KeyOf>
struct SingleKey {
  KeyOf key_of;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id item, const Visit& visit) const {
    visit(key_of(item));
  }
};

}  // namespace detail

/// Groups whose members have been counted, and are yet to be placed.
template <class Index, class Memory>
struct CountedGroups {
  Array<Index, Memory> begin;  ///< where each group begins, and the end of the last, once all its members are placed
  Array<Index, Memory> next;   ///< the place of each group's next member: adding to it takes that
  Index members;               ///< how many there are in all
};

/// Counts the members of groups (see group_by) with atomics.
template <class Index, class Space, class VisitKeys>
CountedGroups<Index, typename Space::memory_space> count_groups(const std::string& label, const Space& space,
                                                                Offset items, Offset keys,
                                                                const VisitKeys& visit_keys) {
  using Indices = Array<Index, typename Space::memory_space>;
  // One entry ahead of `begin`: placing moves the start of each group to its end, which is the next group's start.
  const auto all = allocate<Indices>(label, keys + 2);
  Kokkos::deep_copy(all, Index(0));
  const Indices next = Kokkos::subview(all, std::make_pair(Offset(1), keys + 2));
  parallel_for((label + "_count").c_str(), space, items, detail::CountMembers<Indices, VisitKeys>{visit_keys, next});
  const Index total = exclusive_scan((label + "_scan").c_str(), space, keys, next, next);
  return {Kokkos::subview(all, std::make_pair(Offset(0), keys + 1)), next, total};
}

/// Groups the items 0..items-1 by keys 0..keys-1: row k has the items of key k, in no order. `visit_keys(item, visit)`
/// calls visit(key) for each key of an item, of which there may be any number; it is called twice for each item, with
/// the same keys both times. On a device it is a functor whose call operator is a template, as nvcc has no generic
/// lambdas in kernels.
///
/// `Index` counts the members: Id where there are at most 2^31 - 1. Time and memory O(items + keys + members). On the
/// host each thread counts by itself, unless that takes more memory than a number an item.
template <class Index = Offset, class Space, class VisitKeys>
Csr<Id, typename Space::memory_space, Index> group_by(const char* label, const Space& space, Offset items, Offset keys,
                                                      const VisitKeys& visit_keys) {
  using Memory = typename Space::memory_space;
  using Indices = Array<Index, Memory>;
  using Members = Array<Id, Memory>;
  if constexpr (!is_device<Space>) {
    const int parts = detail::threads_for(items);
    if (parts == 1 || parts * keys <= items)
      return detail::group_by_parts<Index>(label, items, keys, parts, visit_keys);
  }
  const auto counted = count_groups<Index>(label, space, items, keys, visit_keys);
  const auto members = allocate<Members>(label, counted.members);
  parallel_for((std::string(label) + "_fill").c_str(), space, items,
               detail::FillGroups<Indices, Members, VisitKeys>{visit_keys, counted.next, members});
  return {counted.begin, members};
}

/// Groups items that have one key each: `key_of(item)`.
template <class Index = Offset, class Space, class KeyOf>
Csr<Id, typename Space::memory_space, Index> group_by_key(const char* label, const Space& space, Offset items,
                                                          Offset keys, const KeyOf& key_of) {
  return group_by<Index>(label, space, items, keys, detail::SingleKey<KeyOf>{key_of});
}

}  // namespace gale
