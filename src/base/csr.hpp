#pragma once

#include <type_traits>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Consecutive entries of an array. Owns nothing.
template <class T>
struct Span {
  T* entries = nullptr;  ///< the first entry
  Offset count = 0;      ///< how many there are

  /// How many entries there are.
  KOKKOS_FUNCTION Offset size() const { return count; }

  /// The i-th entry, counted from 0. Nothing is checked.
  KOKKOS_FUNCTION T& operator[](Offset i) const { return entries[i]; }

  /// The first entry.
  KOKKOS_FUNCTION T* begin() const { return entries; }

  /// One past the last entry.
  KOKKOS_FUNCTION T* end() const { return entries + count; }
};

/// Rows of entries in two arrays, as Kokkos-Kernels, scipy and others take sparse matrices: row i is
/// entries(offsets(i)) to entries(offsets(i + 1) - 1). A whole relation is one, and so is whatever is grouped.
///
/// The arrays lie in `Memory`; copies share them. `T` const: nobody writes either. `Index` counts the entries: Id where
/// there are at most 2^31 - 1.
template <class T, class Memory, class Index = Offset>
struct Csr {
  /// Where rows begin.
  using Offsets = Array<std::conditional_t<std::is_const_v<T>, const Index, Index>, Memory>;

  Offsets offsets;           ///< where each row begins, and the end of the last; empty where nothing was made
  Array<T, Memory> entries;  ///< the entries, row after row

  /// How many rows there are.
  KOKKOS_FUNCTION Offset rows() const {
    const auto count = static_cast<Offset>(offsets.extent(0));
    return count == 0 ? 0 : count - 1;
  }

  /// The entries of a row, counted from 0. Nothing is checked.
  KOKKOS_FUNCTION Span<T> row(Offset i) const { return {entries.data() + offsets(i), offsets(i + 1) - offsets(i)}; }

  /// Gives the arrays to whoever only reads them.
  template <class U, class = std::enable_if_t<std::is_same_v<U, const T> && !std::is_const_v<T>>>
  operator Csr<U, Memory, Index>() const {
    return {offsets, entries};
  }
};

}  // namespace gale
