#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/large_lower_star.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/pair_fan.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::detail {

/// One consumer's part in the sweep of `find_discrete_gradient`.
class GradientSweep {
 public:
  GradientSweep(GradientStore& store, int consumer)
      : sink_(store.sink(consumer)),
        keys_(store.order.keys()),
        cell_input_(store.mesh.cells_in_input()),
        dimension_(store.mesh.dimension()) {}

  /// Pairs the stars of a segment's vertices.
  void pair(const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV], cells = rows[vertex_cells(dimension_)];
    const LinkRows links = rows.links();
    const auto star_of = [&](Id v) { return VertexStar{v, neighbours[v], cells[v], links[v]}; };
    if (dimension_ == 3) {
      for (const Id v : rows.interval(Relation::VV)) pair_tetrahedra(star_of(v));
    } else {
      for (const Id v : rows.interval(Relation::VV)) pair_triangles(star_of(v));
    }
  }

  /// Pairs one.
  void pair(const VertexStar& star) {
    if (dimension_ == 3) {
      pair_tetrahedra(star);
    } else {
      pair_triangles(star);
    }
  }

 private:
  void pair_tetrahedra(const VertexStar& star) {
    if (!lower_.find(keys_, star.vertex, star.neighbours) ||
        (!pair_star_of_words<1, false>(sink_, star, lower_) && !pair_star_of_words<2, false>(sink_, star, lower_)))
      pair_star(sink_, star, many_lower_, built(star), large_);
  }

  void pair_triangles(const VertexStar& star) {
    if (!pair_small_fan(sink_, keys_, star)) pair_large_fan(sink_, star, many_lower_, built(star));
  }

  /// The star of a vertex that is too large for bits, whose lower neighbours `many_lower_` becomes.
  LargeLowerStar& built(const VertexStar& star) {
    many_lower_.find(keys_, star.vertex, star.neighbours);
    large_.build(many_lower_.ranks(), many_lower_.count(), star.link,
                 [&](Id place) { return cell_input_[star.cells[place]]; });
    return large_;
  }

  const ConsumerSink sink_;
  const std::uint64_t* keys_;
  const OtherIds cell_input_;
  const int dimension_;
  LowerNeighbours lower_;
  ManyLowerNeighbours many_lower_;
  LargeLowerStar large_;
};

}  // namespace gale::detail
