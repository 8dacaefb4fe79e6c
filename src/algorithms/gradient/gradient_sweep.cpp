#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>

namespace gale::detail {

GradientSweep::GradientSweep(GradientStore& store, int consumer)
    : store_(store),
      consumer_(consumer),
      keys_(store.order.keys()),
      tetrahedron_input_(store.mesh.tetrahedron_input().data()) {}

void GradientSweep::pair(const SegmentRows& rows) {
  const Rows neighbours = rows[Relation::VV], tetrahedra = rows[Relation::VT];
  const LinkRows links = rows.links();
  for (const Id v : rows.interval(Relation::VV)) pair(VertexStar{v, neighbours[v], tetrahedra[v], links[v]});
}

void GradientSweep::pair(const VertexStar& star) {
  if (!lower_.find(keys_, star.vertex, star.neighbours)) return pair_large(star);
  if (!pair_small<1>(star) && !pair_small<2>(star)) pair_large(star);
}

/// Pairs the star by sets of bits; false if it is too large.
template <int Words>
bool GradientSweep::pair_small(const VertexStar& star) {
  LowerStar<Words> cells;
  if (!cells.build(lower_, star.link)) return false;
  pair_star(ConsumerSink{store_, consumer_}, star, lower_, cells, BitQueues<LowerStar<Words>>(cells));
  return true;
}

void GradientSweep::pair_large(const VertexStar& star) {
  many_lower_.find(keys_, star.vertex, star.neighbours);
  large_.build(many_lower_.ranks(), many_lower_.count(), star.link,
               [&](Id place) { return tetrahedron_input_[star.tetrahedra[place]]; });
  pair_star(ConsumerSink{store_, consumer_}, star, many_lower_, large_, large_);
}

}  // namespace gale::detail
