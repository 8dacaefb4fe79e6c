#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

// Searching and sorting as one thread does by itself, on the host and in kernels.

namespace gale {

/// The first place from `begin` on, before `end`, that isn't before what is sought; `end` if all are.
/// `is_before(place)` holds for some first ones, and for none after these.
GALE_CALLS_ANY
template <class Place, class IsBefore>
KOKKOS_FORCEINLINE_FUNCTION Place bisect(Place begin, Place end, const IsBefore& is_before) {
  while (begin < end) {
    const Place middle = begin + (end - begin) / 2;
    if (is_before(middle)) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  return begin;
}

/// What bisect finds, mostly near `begin`: in ever longer steps from there. On the host.
template <class Place, class IsBefore>
Place gallop(Place begin, Place end, const IsBefore& is_before) {
  Place last = begin;
  for (Offset step = 1; last != end && is_before(last); step *= 2) {
    begin = last + 1;
    last = begin + std::min<Offset>(step, end - begin);
  }
  return bisect(begin, last, is_before);
}

/// A few entries, such as a simplex's vertices, ascending: without branches, which nobody could foretell. On the host.
template <class T, std::size_t N>
std::array<T, N> ascending(std::array<T, N> few) {
  for (std::size_t end = N; end > 1; --end) {
    for (std::size_t i = 0; i + 1 < end; ++i) {
      const T one = few[i], other = few[i + 1];
      few[i] = std::min(one, other);
      few[i + 1] = std::max(one, other);
    }
  }
  return few;
}

/// The root of one of several trees, each of which is followed by way of its parent, a root by itself. Halves the way
/// there for those who ask again. On the host.
inline Id root_of(std::vector<Id>& parents, Id of) {
  while (parents[of] != of) of = parents[of] = parents[parents[of]];
  return of;
}

/// Sorts entries ascending, in place and in n log n time: load(i) is the i-th, store(i, entry) replaces it.
template <class Load, class Store>
KOKKOS_INLINE_FUNCTION void heap_sort(Id count, const Load& load, const Store& store) {
  const auto sift_down = [&](Id root, Id end) {
    const auto entry = load(root);
    for (Id child = 2 * root + 1; child < end; child = 2 * root + 1) {
      if (child + 1 < end && load(child) < load(child + 1)) ++child;
      const auto larger = load(child);
      if (!(entry < larger)) break;
      store(root, larger);
      root = child;
    }
    store(root, entry);
  };
  for (Id root = count / 2 - 1; root >= 0; --root) sift_down(root, count);
  for (Id end = count - 1; end > 0; --end) {
    const auto last = load(end);
    store(end, load(0));
    store(0, last);
    sift_down(0, end);
  }
}

}  // namespace gale
