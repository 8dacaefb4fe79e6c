#pragma once

#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence/turned_edges.hpp>

namespace gale::detail {

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
