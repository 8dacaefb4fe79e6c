#pragma once

#include <array>
#include <vector>

#include <gale/base/types.hpp>

namespace gale {

/// The simplices that a discrete gradient pairs with no other, in GALE's ids: the vertices of each from the highest to
/// the lowest, and of a cell its id. In the order of the numbers that users know them by (`SimplexNumbers`).
struct CriticalSimplices {
  int dimension = 3;                         ///< the mesh's: 3 where cells are tetrahedra, 2 where they are triangles
  std::vector<Id> vertices;                  ///< minima
  std::vector<std::array<Id, 2>> edges;      ///< 1-saddles; the saddles of a triangle mesh
  std::vector<std::array<Id, 3>> triangles;  ///< 2-saddles; none of a triangle mesh
  std::vector<Id> cells;                     ///< maxima: tetrahedra, or triangles of a triangle mesh

  /// The tetrahedra of the i-th triangle, by input id: star[star_begin[i]] to star[star_begin[i + 1] - 1]. On a
  /// triangle mesh the triangles of the i-th edge.
  std::vector<Id> star_begin{0};
  std::vector<Id> star;  ///< GALE's ids, see star_begin

  /// How many critical simplices there are of each dimension, 0 to 3; of a triangle mesh none of the last.
  std::array<Id, 4> counts() const {
    const auto minima = static_cast<Id>(vertices.size()), saddles = static_cast<Id>(edges.size()),
               maxima = static_cast<Id>(cells.size());
    if (dimension == 2) return {minima, saddles, maxima, 0};
    return {minima, saddles, static_cast<Id>(triangles.size()), maxima};
  }

  /// Alternating sum of the counts: the mesh's Euler characteristic.
  std::int64_t euler() const {
    const auto c = counts();
    return std::int64_t(c[0]) - c[1] + c[2] - c[3];
  }
};

}  // namespace gale
