#pragma once

#include <unordered_map>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// Where paths to extrema lead when some of these are cancelled: a copy of the successors of all vertices, or of all
/// tetrahedra, in which paths are turned around. A path crosses a cancelled saddle from one of its sides to the other.
class TurnedForest {
 public:
  explicit TurnedForest(const Array<const Id, HostMemory>& successors);

  const Array<Id, HostMemory>& successors() const { return successors_; }

  /// A saddle on a path: the cells before and behind it.
  struct Crossing {
    Id saddle, from;
  };

  /// Turns around the path from `side`, which crosses no saddle, and lets it cross `saddle` to `other` instead, or
  /// outside where that is no_id. So the extremum where it ended is no more.
  void turn(Id side, Id other, Id saddle);

  /// The saddles that the paths from both sides of a saddle cross before they meet: it is on one cycle with them. Empty
  /// if the paths end apart, and then it is on none.
  std::vector<Crossing> cycle(Id side, Id other) const;

  /// Cancels `saddle`, whose sides these are, instead of one of its cycle.
  void exchange(Id side, Id other, Id saddle, const Crossing& instead);

 private:
  std::vector<Crossing> crossings(Id from, std::vector<Id>& path) const;

  Array<Id, HostMemory> successors_;
  std::unordered_map<Id, Id> saddle_from_;  ///< the saddle that a cell's path crosses next, if it does
  std::vector<char> crosses_;               ///< whether it may: saves most look-ups
};

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

/// The connectors of a complex whose gradient is being turned: most are still paths when their ends are cancelled.
class FirstPaths {
 public:
  FirstPaths(const MorseSmaleComplex& complex, const TurnedEdges& turned);

  /// Makes `path` the connector from a 1-saddle to a 2-saddle. False if there is none, or an edge of it was turned.
  bool take(Id lower, Id upper, std::vector<TriangleVertices>& path) const;

 private:
  bool is_turned(Id high, Id low) const { return turned_.find(high, low) != nullptr; }

  const MorseSmaleComplex& complex_;
  const TurnedEdges& turned_;
  std::vector<Id> begin_;  ///< the first connector to each 2-saddle
};

}  // namespace gale::detail
