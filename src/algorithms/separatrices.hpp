#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/base/types.hpp>

namespace gale {

/// Paths along a discrete gradient from one critical simplex to another, or surfaces from one: the i-th is
/// cells[begin[i]] to cells[begin[i + 1] - 1].
template <class Cell>
struct Separatrices {
  std::vector<Id> sources;            ///< the place of each one's first simplex in CriticalSimplices
  std::vector<Id> destinations;       ///< the place of its last simplex; empty for surfaces
  std::vector<std::uint8_t> is_only;  ///< for saddle connectors: 1 if there is no other path between the two
  std::vector<Offset> begin{0};
  std::vector<Cell> cells;

  Id count() const { return static_cast<Id>(sources.size()); }
  const Cell* first(Id i) const { return cells.data() + begin[i]; }
  const Cell* last(Id i) const { return cells.data() + begin[i + 1]; }
};

/// GALE's ids of a triangle's vertices.
using TriangleVertices = std::array<Id, 3>;

}  // namespace gale
