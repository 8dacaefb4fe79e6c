#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale::ttk {

/// The caller's tetrahedra in the caller's order, where the caller has them.
class Cells {
 public:
  Cells() = default;

  /// `first`: corner k of cell c is first[stride * c + k]. In TTK's flat layout it is one past the array's begin and
  /// the stride is 5; in that of connectivity and offsets it is 4.
  Cells(const long long* first, int stride, Id count) : first_(first), stride_(stride), count_(count) {}

  Id count() const { return count_; }
  Id vertex(Id cell, int corner) const { return static_cast<Id>(first_[stride_ * cell + corner]); }

  void prefetch(Id cell) const { __builtin_prefetch(first_ + stride_ * cell); }

  /// Throws gale::Error for a vertex that isn't one of `points`, or that a cell has twice.
  GALE_EXPORT void require_valid(Id points) const;

  /// All corners, in short ids. Throws likewise.
  GALE_EXPORT Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> copy(Id points) const;

  /// Which of a cell's corners some vertices are, as bits.
  template <class Vertices>
  unsigned corners_of(Id cell, const Vertices& vertices) const {
    unsigned bits = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Id here = vertex(cell, corner);
      for (const Id wanted : vertices) bits |= unsigned(here == wanted) << corner;
    }
    return bits;
  }

 private:
  const long long* first_ = nullptr;
  Offset stride_ = 5;
  Id count_ = 0;
};

/// The corners of a cell's edges and triangles, in the order in which TTK lists them.
inline constexpr int edge_corners[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
inline constexpr int triangle_corners[4][3] = {{0, 1, 2}, {1, 2, 3}, {2, 3, 0}, {3, 0, 1}};

/// The place in that order of the edge or the triangle with some corners, given as bits; -1 for other sets.
inline constexpr int place_of_corners[16] = {-1, -1, -1, 0, -1, 1, 3, 0, -1, 2, 4, 3, 5, 2, 1, -1};

}  // namespace gale::ttk
