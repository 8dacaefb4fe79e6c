#pragma once

#include <unordered_map>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>

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

}  // namespace gale::detail
