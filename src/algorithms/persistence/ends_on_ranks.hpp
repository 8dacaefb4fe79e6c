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

/// The ends of the paths from this rank's critical edges and facets.
struct EndsOfSaddles {
  std::vector<SentEnds> of_edges, of_facets;
};

/// What ends_of_edges and ends_of_facets find, where paths may end on other ranks. `places` has those of this rank's
/// critical simplices. Collective.
EndsOfSaddles ends_on_ranks(const DiscreteGradient& gradient, const CriticalPlaces& places);

}  // namespace gale::detail
