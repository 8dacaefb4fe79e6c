#pragma once

#include <array>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Consecutive ids, `first` to `last` - 1.
struct Interval {
  Id first = 0;
  Id last = 0;

  KOKKOS_FUNCTION Id size() const { return last - first; }
  KOKKOS_FUNCTION bool has(Id id) const { return id >= first && id < last; }

  /// To go through the ids with a range-based for.
  class Iterator {
   public:
    KOKKOS_FUNCTION explicit Iterator(Id id) : id_(id) {}
    KOKKOS_FUNCTION Id operator*() const { return id_; }
    KOKKOS_FUNCTION Iterator& operator++() {
      ++id_;
      return *this;
    }
    KOKKOS_FUNCTION bool operator!=(const Iterator& other) const { return id_ != other.id_; }

   private:
    Id id_;
  };
  KOKKOS_FUNCTION Iterator begin() const { return Iterator(first); }
  KOKKOS_FUNCTION Iterator end() const { return Iterator(last); }
};

/// Of vertices, edges, triangles and tetrahedra; empty for those that aren't enumerated.
using Intervals = std::array<Interval, 4>;

}  // namespace gale
