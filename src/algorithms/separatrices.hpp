#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/base/types.hpp>

namespace gale {

/// Whether paths are told whole, or each as far as the first cell that it has in common with an earlier one to the same
/// end: then no cell of a kind is told twice, but where paths meet.
enum class Paths { whole, joined };

/// Paths along a discrete gradient from one critical simplex to another, or surfaces from one: the i-th is
/// cells[begin[i]] to cells[begin[i + 1] - 1].
template <class Cell>
struct Separatrices {
  std::vector<Id> sources;            ///< the place of each one's first simplex in CriticalSimplices
  std::vector<Id> destinations;       ///< the place of its last simplex; empty for surfaces
  std::vector<std::uint8_t> is_only;  ///< for saddle connectors: 1 if there is no other path between the two

  /// For joined paths 1 if its last cell is also one of an earlier path to the same destination, and it goes on as that
  /// one does. Empty: each path is whole.
  std::vector<std::uint8_t> joins;
  std::vector<Offset> begin{0};  ///< where each one's cells begin, and the end of the last
  std::vector<Cell> cells;       ///< the cells on the way, one path after the other

  /// How many paths, or surfaces, there are.
  Id count() const { return static_cast<Id>(sources.size()); }

  /// Whether the i-th is told to its end.
  bool is_whole(Id i) const { return joins.empty() || joins[i] == 0; }

  /// The first cell of the i-th.
  const Cell* first(Id i) const { return cells.data() + begin[i]; }

  /// One past the last cell of the i-th.
  const Cell* last(Id i) const { return cells.data() + begin[i + 1]; }
};

/// GALE's ids of a triangle's vertices.
using TriangleVertices = std::array<Id, 3>;

}  // namespace gale
