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
  GradientSweep(GradientStore& store, int consumer)
      : sink_(store.sink(consumer)),
        keys_(store.order.keys()),
        tetrahedron_input_(store.mesh.tetrahedron_input().data()) {}

  /// Pairs the stars of a segment's vertices.
  void pair(const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV], tetrahedra = rows[Relation::VT];
    const LinkRows links = rows.links();
    for (const Id v : rows.interval(Relation::VV)) pair(VertexStar{v, neighbours[v], tetrahedra[v], links[v]});
  }

  /// Pairs one.
  void pair(const VertexStar& star) {
    if (!lower_.find(keys_, star.vertex, star.neighbours) ||
        (!pair_star_of_words<1, false>(sink_, star, lower_) && !pair_star_of_words<2, false>(sink_, star, lower_)))
      pair_large(star);
  }

 private:
  void pair_large(const VertexStar& star) {
    many_lower_.find(keys_, star.vertex, star.neighbours);
    large_.build(many_lower_.ranks(), many_lower_.count(), star.link,
                 [&](Id place) { return tetrahedron_input_[star.tetrahedra[place]]; });
    pair_star(sink_, star, many_lower_, large_, large_);
  }

  const ConsumerSink sink_;
  const std::uint64_t* keys_;
  const Id* tetrahedron_input_;
  LowerNeighbours lower_;
  ManyLowerNeighbours many_lower_;
  LargeLowerStar large_;
};

}  // namespace gale::detail
