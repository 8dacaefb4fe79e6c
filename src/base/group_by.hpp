#pragma once

#include <string>
#include <utility>

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

template <class Indices>
struct MemberCount {
  Indices counts;

  KOKKOS_FUNCTION typename Indices::value_type operator()(Offset key) const { return counts(key); }
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

/// Groups the items 0..items-1 by keys 0..keys-1: row k has the items of key k, in no order. `visit_keys(item, visit)`
/// calls visit(key) for each key of an item, of which there may be any number; it is called twice for each item, with
/// the same keys both times. On a device it is a functor whose call operator is a template, as nvcc has no generic
/// lambdas in kernels.
///
/// `Index` counts the members: Id where there are at most 2^31 - 1. Time and memory O(items + keys + members).
template <class Index = Offset, class Space, class VisitKeys>
Csr<Id, typename Space::memory_space, Index> group_by(const char* label, const Space& space, Offset items, Offset keys,
                                                      const VisitKeys& visit_keys) {
  using Memory = typename Space::memory_space;
  using Indices = Array<Index, Memory>;
  using Members = Array<Id, Memory>;
  // One entry ahead of `begin`: filling moves the start of each group to its end, which is the next group's start.
  const auto all = allocate<Indices>(label, keys + 2);
  Kokkos::deep_copy(all, Index(0));
  const Indices next = Kokkos::subview(all, std::make_pair(Offset(1), keys + 2));
  parallel_for((std::string(label) + "_count").c_str(), space, items,
               detail::CountMembers<Indices, VisitKeys>{visit_keys, next});
  const Index total =
      exclusive_scan((std::string(label) + "_scan").c_str(), space, keys, next, detail::MemberCount<Indices>{next});
  const auto members = allocate<Members>(label, total);
  parallel_for((std::string(label) + "_fill").c_str(), space, items,
               detail::FillGroups<Indices, Members, VisitKeys>{visit_keys, next, members});
  return {Kokkos::subview(all, std::make_pair(Offset(0), keys + 1)), members};
}

/// Groups items that have one key each: `key_of(item)`.
template <class Index = Offset, class Space, class KeyOf>
Csr<Id, typename Space::memory_space, Index> group_by_key(const char* label, const Space& space, Offset items,
                                                          Offset keys, const KeyOf& key_of) {
  return group_by<Index>(label, space, items, keys, detail::SingleKey<KeyOf>{key_of});
}

}  // namespace gale
