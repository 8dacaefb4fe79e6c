#pragma once

#include <array>

#include <gale/algorithms/gradient/gradient_store.hpp>

namespace gale::detail {

/// The edges of a gradient as the host reads them. Refers to the gradient.
class EdgesOnHost {
 public:
  explicit EdgesOnHost(const DiscreteGradient& gradient)
      : keys_(gradient.order().keys()),
        pairs_(gradient.store().pairs()),
        vertex_successor_(gradient.store().vertex_steps()),
        has_triangles_(gradient.mesh().dimension() == 3) {}

  bool is_higher(Id one, Id other) const { return keys_[one] > keys_[other]; }

  /// An edge, the higher end first.
  std::array<Id, 2> ordered(Id a, Id b) const {
    return is_higher(a, b) ? std::array<Id, 2>{a, b} : std::array<Id, 2>{b, a};
  }

  /// What DiscreteGradient::vertex_successor says of a vertex.
  Id vertex_successor(Id vertex) const { return vertex_successor_[vertex]; }

  /// What an edge is paired with, whose higher end this rank owns: the third vertex of that triangle, or why there is
  /// none. Triangles of a mesh of triangles are none here.
  Id third(Id high, Id low) const {
    if (has_triangles_) {
      const PairedEdges row = pairs_[high];
      const Id third = row.third(row.find(low));
      if (third != no_id) return third;
    }
    return vertex_successor_[high] == low ? edge_has_vertex : edge_is_critical;
  }

 private:
  const std::uint64_t* keys_;
  const EdgePairs& pairs_;
  const VertexSteps vertex_successor_;
  const bool has_triangles_;
};

}  // namespace gale::detail
