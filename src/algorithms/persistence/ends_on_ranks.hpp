#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>

namespace gale::detail {

/// Where a path from a saddle ends: the rank that has the extremum, and its place there; `outside` if it leaves the
/// mesh.
struct SentEnd {
  static constexpr int outside = -1;
  int rank = outside;
  Id place = no_id;
};
using SentEnds = std::array<SentEnd, 2>;

/// What ends_of_edges finds, for this rank's critical edges, where paths may end on others. `places` has those of this
/// rank's critical simplices. Collective.
std::vector<SentEnds> ends_of_edges_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// What ends_of_facets finds, for this rank's critical facets, where paths may end on others. Collective.
std::vector<SentEnds> ends_of_facets_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places);

}  // namespace gale::detail
