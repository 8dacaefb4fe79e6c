#pragma once

#include <array>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Consecutive ids, `first` to `last` - 1.
struct Interval {
  Id first = 0;  ///< the first id
  Id last = 0;   ///< one past the last id

  /// How many ids there are.
  KOKKOS_FUNCTION Id size() const { return last - first; }

  /// Whether an id is one of them.
  KOKKOS_FUNCTION bool has(Id id) const { return id >= first && id < last; }

  /// The i-th id from 0 on that is outside the interval.
  KOKKOS_FUNCTION Id outside(Offset i) const { return static_cast<Id>(i < first ? i : i + size()); }

  /// Goes through the ids, for range-based loops.
  class Iterator {
   public:
    /// Stands at that id.
    KOKKOS_FUNCTION explicit Iterator(Id id) : id_(id) {}

    /// The id.
    KOKKOS_FUNCTION Id operator*() const { return id_; }

    /// Goes to the next id.
    KOKKOS_FUNCTION Iterator& operator++() {
      ++id_;
      return *this;
    }

    /// Whether the two stand at different ids.
    KOKKOS_FUNCTION bool operator!=(const Iterator& other) const { return id_ != other.id_; }

   private:
    Id id_;
  };

  /// At the first id.
  KOKKOS_FUNCTION Iterator begin() const { return Iterator(first); }

  /// Past the last id.
  KOKKOS_FUNCTION Iterator end() const { return Iterator(last); }
};

/// The ids of vertices, edges, triangles and tetrahedra; empty for those that aren't enumerated.
using Intervals = std::array<Interval, 4>;

}  // namespace gale
