#include <gale/algorithms/gradient/bit_queues.hpp>
#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/algorithms/gradient/pair_cells.hpp>

namespace gale::detail {

GradientSweep::GradientSweep(GradientStore& store, int consumer)
    : store_(store),
      consumer_(consumer),
      keys_(store.order.keys()),
      tetrahedron_input_(store.mesh.tetrahedron_input().data()) {}

void GradientSweep::pair(const SegmentRows& rows) {
  const Rows neighbours = rows[Relation::VV], tetrahedra = rows[Relation::VT];
  const LinkRows links = rows.links();
  for (const Id v : rows.interval(Relation::VV)) pair({v, neighbours[v], tetrahedra[v], links[v]});
}

void GradientSweep::pair(const Star& star) {
  if (!lower_.find(keys_, star.vertex, star.neighbours)) return pair_large(star);
  if (!pair_small<1>(star) && !pair_small<2>(star)) pair_large(star);
}

/// Pairs the star by sets of bits; false if it is too large.
template <int Words>
bool GradientSweep::pair_small(const Star& star) {
  LowerStar<Words> cells;
  if (!cells.build(lower_, star.link)) return false;
  pair(star, lower_, cells, BitQueues<LowerStar<Words>>(cells));
  return true;
}

void GradientSweep::pair_large(const Star& star) {
  many_lower_.find(keys_, star.vertex, star.neighbours);
  large_.build(many_lower_.ranks(), many_lower_.count(), star.link,
               [&](Id place) { return tetrahedron_input_[star.tetrahedra[place]]; });
  pair(star, many_lower_, large_, large_);
}

template <class Lower, class Cells, class Queues>
void GradientSweep::pair(const Star& star, const Lower& lower, const Cells& cells, Queues&& queues) {
  const auto id = [&](int rank) { return star.neighbours[lower.place(lower.with_rank(rank))]; };
  EdgePairRow edges = store_.begin_edges(consumer_, star.vertex, lower.count());
  for (int i = 0; i < lower.count(); ++i) edges.set_id(i, star.neighbours[lower.place(i)]);
  store_.set_vertex(consumer_, star.vertex, lower.count() == 0 ? no_id : id(0));
  if (lower.count() == 0) return;
  const auto pair = [&](int facet, int cell) {
    const auto& low = cells.corners(facet);
    if (cells.dimension(cell) == 2) {
      const auto& both = cells.corners(cell);
      edges.pair(lower.with_rank(low[0]), lower.with_rank(both[0] == low[0] ? both[1] : both[0]));
    } else {
      const Id place = cells.place(cell), across = cells.across(facet, place);
      store_.set_tetrahedron(star.tetrahedra[place], across == Cells::no_place
                                                         ? surface_successor(star, place, id(low[0]), id(low[1]))
                                                         : star.tetrahedra[across]);
      if constexpr (Cells::may_fork) {
        cells.for_each_tetrahedron(facet, [&](Id other) {
          if (other != place && other != across)
            store_.add_successor(consumer_, star.tetrahedra[place], star.tetrahedra[other]);
        });
      }
    }
  };
  const auto critical = [&](int cell) {
    const auto& corners = cells.corners(cell);
    switch (cells.dimension(cell)) {
      case 1:
        return store_.add_critical_edge(consumer_, star.vertex, id(corners[0]));
      case 3:
        return store_.add_critical_tetrahedron(consumer_, star.tetrahedra[cells.place(cell)]);
    }
    const std::array<Id, 3> triangle = {star.vertex, id(corners[0]), id(corners[1])};
    store_.add_critical_triangle(consumer_, triangle);
    cells.for_each_tetrahedron(cell,
                               [&](Id place) { store_.add_to_star(consumer_, triangle, star.tetrahedra[place]); });
  };
  pair_cells(queues, pair, critical);
}

/// The successor of the tetrahedron at `place`, which is paired with its triangle (vertex, a, b) on the surface.
Id GradientSweep::surface_successor(const Star& star, Id place, Id a, Id b) const {
  for (int corner = 0; corner < 3; ++corner) {
    const Id other = star.neighbours[star.link(place, corner)];
    if (other != a && other != b) return GradientStore::outside(corner + (other > star.vertex ? 1 : 0));
  }
  return no_id;
}

}  // namespace gale::detail
