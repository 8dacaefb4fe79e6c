#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/large_lower_star.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::detail {

/// One consumer's part in the sweep of `find_discrete_gradient`.
class GradientSweep {
 public:
  GradientSweep(GradientStore& store, int consumer);

  /// Pairs the stars of a segment's vertices.
  void pair(const SegmentRows& rows);

  /// Pairs one.
  void pair(const VertexStar& star);

 private:
  template <int Words>
  bool pair_small(const VertexStar& star);
  void pair_large(const VertexStar& star);

  GradientStore& store_;
  int consumer_;
  const std::uint64_t* keys_;
  const Id* tetrahedron_input_;
  LowerNeighbours lower_;
  ManyLowerNeighbours many_lower_;
  LargeLowerStar large_;
};

}  // namespace gale::detail
