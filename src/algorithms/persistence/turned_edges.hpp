#pragma once

#include <vector>

#include <gale/base/hash_table.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// Edges that are paired otherwise than in a gradient, because paths of it were turned around.
class TurnedEdges {
 public:
  /// Instead of a third vertex: the edge is paired with one of its own.
  static constexpr Id with_vertex = -2;

  explicit TurnedEdges(Id vertices) : is_high_(vertices, 0) {}

  /// Pairs an edge with the triangle of this third vertex, which may be higher than both of its own.
  void set(Id high, Id low, Id third) {
    is_high_[high] = 1;
    thirds_.insert(pair_key(high, low)).first = third;
  }

  /// The third vertex of an edge that is paired otherwise; nullptr for all others.
  const Id* find(Id high, Id low) const { return is_high_[high] != 0 ? thirds_.find(pair_key(high, low)) : nullptr; }

 private:
  std::vector<char> is_high_;  ///< whether a vertex is the higher end of one: few are
  HashTable<Id> thirds_;
};

}  // namespace gale::detail
