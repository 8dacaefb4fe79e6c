#pragma once

#include <array>
#include <memory>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/excerpt/falling_edges.hpp>
#include <gale/algorithms/excerpt/shared_set.hpp>

namespace gale::detail {

/// Edges of one rank's part that fall along a gradient of tetrahedra, for one who asks: by kernels where these found
/// the gradient, else on all threads of the host. Refers to the gradient.
class EdgeFall {
 public:
  /// With `expects_all` it begins with room for the open edges of all walls.
  explicit EdgeFall(const DiscreteGradient& gradient, bool expects_all = false);

  /// Lets some edges fall, the higher ends first, and all that they come to. Returns those of these that are other
  /// ranks' to follow: in the calls before perhaps, too.
  std::vector<std::array<Id, 2>> fall(std::vector<std::array<Id, 2>> edges);

  /// The edges that were passed, once: the higher end first, and the third vertices of triangles that they are paired
  /// with, or edge_is_critical. None of those that are paired with vertices, or other ranks' to follow.
  std::vector<std::array<Id, 3>> passed();

 private:
  std::vector<std::array<Id, 2>> fall_on_host(std::vector<std::array<Id, 2>> open);

  const DiscreteGradient& gradient_;
  std::unique_ptr<FallingEdges> by_kernels_;
  const bool expects_all_;
  bool is_on_host_;
  std::vector<std::array<Id, 2>> starts_;  ///< all that kernels were given
  SharedSet known_;                        ///< on the host
  std::vector<std::array<Id, 3>> passed_;  ///< there, too
};

}  // namespace gale::detail
