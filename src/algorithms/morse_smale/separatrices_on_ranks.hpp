#pragma once

#include <gale/algorithms/morse_smale.hpp>

namespace gale::detail {

/// Where the 1-separatrices of a gradient's critical edges, or triangles, start, each with its source's place among
/// these: see descending_separatrices and ascending_separatrices.
struct PathStarts {
  std::vector<Id> simplices, sources;
};
PathStarts descending_starts(const Mesh& mesh, const CriticalSimplices& critical);
PathStarts ascending_starts(const CriticalSimplices& critical);

/// The separatrices that descend from this rank's critical edges, and those that ascend from its critical triangles,
/// with the cells that other ranks hold: these are appended to `beyond`.
///
/// The ranks that a path visits are found by halves: each knows where the path is 2^k changes of ranks later. Then all
/// of them send their pieces at once: two rounds of messages more than the ends of all paths take. Collective.
Separatrices<Id> descending_separatrices_on_ranks(const DiscreteGradient& gradient, SimplicesBeyond& beyond);
Separatrices<Id> ascending_separatrices_on_ranks(const DiscreteGradient& gradient, SimplicesBeyond& beyond);

}  // namespace gale::detail
