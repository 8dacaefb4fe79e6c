#pragma once

#include <array>
#include <vector>

#include <gale/base/types.hpp>

namespace gale {

/// The simplices that a discrete gradient pairs with no other, in GALE's ids: the vertices of each from the highest to
/// the lowest, and of a tetrahedron its id. In the order of the numbers that users know them by (`SimplexNumbers`).
struct CriticalSimplices {
  std::vector<Id> vertices;                  ///< minima
  std::vector<std::array<Id, 2>> edges;      ///< 1-saddles
  std::vector<std::array<Id, 3>> triangles;  ///< 2-saddles
  std::vector<Id> tetrahedra;                ///< maxima

  /// The tetrahedra of the i-th triangle, by input id: star[star_begin[i]] to star[star_begin[i + 1] - 1].
  std::vector<Id> star_begin{0};
  std::vector<Id> star;  ///< GALE's ids, see star_begin

  /// How many critical simplices there are of each dimension, 0 to 3.
  std::array<Id, 4> counts() const {
    return {static_cast<Id>(vertices.size()), static_cast<Id>(edges.size()), static_cast<Id>(triangles.size()),
            static_cast<Id>(tetrahedra.size())};
  }

  /// Alternating sum of the counts: the mesh's Euler characteristic.
  std::int64_t euler() const {
    const auto c = counts();
    return std::int64_t(c[0]) - c[1] + c[2] - c[3];
  }
};

}  // namespace gale
