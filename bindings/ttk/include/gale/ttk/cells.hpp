#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale::ttk {

/// The caller's tetrahedra, or triangles, in the caller's order, where the caller has them.
class Cells {
 public:
  Cells() = default;

  /// `first`: corner k of cell c, of 3 or 4 corners, is first[stride * c + k]. In TTK's flat layout it is one past the
  /// array's begin and the stride is one more than the corners; in that of connectivity and offsets it is as many.
  Cells(const long long* first, int corners, int stride, Id count)
      : first_(first), corners_(corners), stride_(stride), count_(count) {}

  Id count() const { return count_; }
  int corners() const { return corners_; }
  int dimension() const { return corners_ - 1; }
  int edges() const { return corners_ * (corners_ - 1) / 2; }  ///< of a cell
  Id vertex(Id cell, int corner) const { return static_cast<Id>(first_[stride_ * cell + corner]); }

  void prefetch(Id cell) const { __builtin_prefetch(first_ + stride_ * cell); }

  /// Throws gale::Error for a vertex that isn't one of `points`, or that a cell has twice.
  GALE_EXPORT void require_valid(Id points) const;

  /// All corners, in short ids. Throws likewise.
  template <int corners>
  GALE_EXPORT Kokkos::View<Id* [corners], Kokkos::LayoutRight, HostMemory> copy(Id points) const;

  /// Which of a cell's corners some vertices are, as bits.
  template <class Vertices>
  unsigned corners_of(Id cell, const Vertices& vertices) const {
    unsigned bits = 0;
    for (int corner = 0; corner < corners_; ++corner) {
      const Id here = vertex(cell, corner);
      for (const Id wanted : vertices) bits |= unsigned(here == wanted) << corner;
    }
    return bits;
  }

  /// Its other corners.
  template <class Vertices>
  unsigned others(Id cell, const Vertices& vertices) const {
    return ((1u << corners_) - 1) ^ corners_of(cell, vertices);
  }

 private:
  const long long* first_ = nullptr;
  int corners_ = 4;
  Offset stride_ = 5;
  Id count_ = 0;
};

/// The corners of a tetrahedron's edges and triangles, in the order in which TTK lists them. Of a triangle's edges the
/// places are those of these corners in a tetrahedron, 0, 1 and 3: the order is TTK's, too.
inline constexpr int edge_corners[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
inline constexpr int triangle_corners[4][3] = {{0, 1, 2}, {1, 2, 3}, {2, 3, 0}, {3, 0, 1}};

/// The place in that order of the edge or the triangle with some corners, given as bits; -1 for other sets.
inline constexpr int place_of_corners[16] = {-1, -1, -1, 0, -1, 1, 3, 0, -1, 2, 4, 3, 5, 2, 1, -1};

}  // namespace gale::ttk
