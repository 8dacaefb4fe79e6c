#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/large_lower_star.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::detail {

/// One consumer's part in the sweep of `find_discrete_gradient`.
class GradientSweep {
 public:
  GradientSweep(GradientStore& store, int consumer);

  void pair(const SegmentRows& rows);

 private:
  /// A vertex and what touches it.
  struct Star {
    Id vertex;
    Row neighbours, tetrahedra;
    LinkRow link;
  };

  void pair(const Star& star);
  template <int Words>
  bool pair_small(const Star& star);
  void pair_large(const Star& star);
  template <class Lower, class Cells, class Queues>
  void pair(const Star& star, const Lower& lower, const Cells& cells, Queues&& queues);
  Id surface_successor(const Star& star, Id place, Id a, Id b) const;

  GradientStore& store_;
  int consumer_;
  const std::uint64_t* keys_;
  const Id* tetrahedron_input_;
  LowerNeighbours lower_;
  ManyLowerNeighbours many_lower_;
  LargeLowerStar large_;
};

}  // namespace gale::detail
