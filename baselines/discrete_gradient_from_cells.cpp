#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/baselines/lower_neighbour_ranks.hpp>
#include <gale/baselines/queued_lower_star.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

namespace gale {

namespace {

/// Rows of face relations from the mesh's tables, as localized structures have them.
class LookedUpFaces {
 public:
  explicit LookedUpFaces(const Simplices<HostMemory>& simplices) : simplices_(simplices) {}

  template <Relation relation>
  auto row(Id simplex) const {
    return face_row<relation>(simplices_, simplex);
  }

 private:
  Simplices<HostMemory> simplices_;
};

/// Rows of face relations from a structure that keeps all rows. One serves one thread; a row is valid until the next of
/// its relation.
class KeptFaces {
 public:
  explicit KeptFaces(Structure& structure) : consumer_(structure.consumer()) {}

  template <Relation relation>
  Row row(Id simplex) const {
    return consumer_->row(relation, simplex);
  }

 private:
  std::unique_ptr<Consumer> consumer_;
};

/// One consumer's part in the sweep of `find_discrete_gradient_from_cells`. `Faces` has row<relation>(simplex) for EV,
/// FV and TV.
template <class Faces>
class CellSweep {
 public:
  CellSweep(detail::GradientStore& store, int consumer, Faces faces)
      : sink_(store.sink(consumer)),
        keys_(store.order.keys()),
        cell_input_(store.mesh.cells_in_input()),
        faces_(std::move(faces)) {}

  void pair(const SegmentRows& rows) {
    const Rows edges = rows[Relation::VE], triangles = rows[Relation::VF], tetrahedra = rows[Relation::VT];
    for (const Id v : rows.interval(Relation::VE)) {
      find_neighbours(v, edges[v]);
      if (begin_row(v)) {
        ranks_.with_look_up([&](const auto& rank) { make_star(v, triangles[v], tetrahedra[v], rank); });
        pair_star(v);
      }
    }
  }

 private:
  /// Finds the other ends of a vertex's edges. They ascend, as the edges' ids do.
  void find_neighbours(Id vertex, const Row& edges) {
    neighbours_.resize(edges.size());
    for (Id i = 0; i < edges.size(); ++i) {
      const auto ends = faces_.template row<Relation::EV>(edges[i]);
      neighbours_[i] = ends[0] ^ ends[1] ^ vertex;
    }
    ranks_.find(keys_, vertex, neighbours_);
  }

  /// Stores the vertex's pair; false if it has none.
  bool begin_row(Id vertex) {
    row_ = sink_.begin_edges(vertex, ranks_.count());
    for (Id i = 0; i < ranks_.count(); ++i) row_.set_id(i, ranks_.lower(i));
    sink_.set_vertex(vertex, ranks_.count() == 0 ? no_id : ranks_.id(0));
    return ranks_.count() != 0;
  }

  template <class Rank>
  void make_star(Id vertex, const Row& triangles, const Row& tetrahedra, const Rank& rank) {
    star_.begin(ranks_.count(), triangles.size(), tetrahedra.size());
    for (const Id f : triangles) {
      const auto v = faces_.template row<Relation::FV>(f);
      star_.add_triangle(rank(other_of(v[0], v[2], vertex)), rank(other_of(v[1], v[2], vertex)));
    }
    star_.end_triangles();
    for (const Id t : tetrahedra) {
      const auto v = faces_.template row<Relation::TV>(t);
      const Id x = rank(other_of(v[0], v[3], vertex)), y = rank(other_of(v[1], v[3], vertex)),
               z = rank(other_of(v[2], v[3], vertex));
      const Id high = most(x, y), low = least(x, y);
      star_.add_tetrahedron(most(high, z), most(low, least(high, z)), least(low, z), t);
    }
    star_.end();
  }

  void pair_star(Id vertex) {
    const auto pair = [&](int facet, int cell) {
      const auto& low = star_.corners(facet);
      const auto& both = star_.corners(cell);
      if (star_.dimension(cell) == 2) {
        row_.pair(ranks_.place(low[0]), ranks_.place(both[0] == low[0] ? both[1] : both[0]));
      } else {
        const Id tetrahedron = star_.tetrahedron(cell), across = star_.across(facet, tetrahedron, cell_input_);
        sink_.set_cell(tetrahedron, across == no_id ? leave(tetrahedron, odd_one(both, low)) : across);
        star_.for_each_tetrahedron(facet, [&](Id other) {
          if (other != tetrahedron && other != across) sink_.add_successor(tetrahedron, other);
        });
      }
    };
    const auto critical = [&](int cell) {
      const auto& corners = star_.corners(cell);
      switch (star_.dimension(cell)) {
        case 1:
          return sink_.add_critical_edge(vertex, ranks_.id(corners[0]));
        case 3:
          return sink_.add_critical_cell(star_.tetrahedron(cell));
      }
      const std::array<Id, 3> triangle = {vertex, ranks_.id(corners[0]), ranks_.id(corners[1])};
      sink_.add_critical_triangle(triangle);
      star_.for_each_tetrahedron(cell, [&](Id tetrahedron) { sink_.add_to_star(triangle, tetrahedron); });
    };
    pair_cells(star_, pair, critical);
  }

  // Without branches, which no processor could predict here.
  static Id least(Id a, Id b) { return b ^ ((a ^ b) & -Id(a < b)); }
  static Id most(Id a, Id b) { return a ^ ((a ^ b) & -Id(a < b)); }

  /// `one`, or `last` where that is the vertex itself.
  static Id other_of(Id one, Id last, Id vertex) { return one ^ ((one ^ last) & -Id(one == vertex)); }

  /// The rank of the vertex that a tetrahedron has and its triangle hasn't.
  static Id odd_one(const detail::QueuedLowerStar::Corners& tetrahedron,
                    const detail::QueuedLowerStar::Corners& triangle) {
    return tetrahedron[0] != triangle[0]   ? tetrahedron[0]
           : tetrahedron[1] != triangle[1] ? tetrahedron[1]
                                           : tetrahedron[2];
  }

  /// The successor of a tetrahedron that is paired with its triangle on the surface, the one opposite the vertex of a
  /// rank.
  Id leave(Id tetrahedron, Id rank) const {
    const auto vertices = faces_.template row<Relation::TV>(tetrahedron);
    int corner = 0;
    while (vertices[corner] != ranks_.id(rank)) ++corner;
    return detail::outside(corner);
  }

  const detail::ConsumerSink sink_;
  const std::uint64_t* keys_;
  OtherIds cell_input_;
  Faces faces_;
  std::vector<Id> neighbours_;
  detail::LowerNeighbourRanks ranks_;
  detail::QueuedLowerStar star_;
  detail::EdgePairRow row_;
};

constexpr RelationSet swept = discrete_gradient_from_cells_relations & coboundary_relations;
constexpr RelationSet looked_up = discrete_gradient_from_cells_relations & face_relations;

/// `faces()` makes a consumer's look-ups.
template <class MakeFaces>
void sweep(Structure& structure, detail::GradientStore& store, int consumers, const SweepOptions& options,
           const MakeFaces& faces) {
  using Sweep = CellSweep<decltype(faces())>;
  std::vector<std::unique_ptr<Sweep>> sweeps;
  for (int i = 0; i < consumers; ++i) sweeps.push_back(std::make_unique<Sweep>(store, i, faces()));
  structure.for_each_segment(swept, options,
                             [&](int consumer, const SegmentRows& rows) { sweeps[consumer]->pair(rows); });
}

}  // namespace

DiscreteGradient find_discrete_gradient_from_cells(Structure& structure, const VertexOrder& order,
                                                   const SweepOptions& options) {
  const ThreadLimit limit(options.threads);
  require_preconditioned(structure.relations(), discrete_gradient_from_cells_relations);
  const int consumers = std::max(options.threads, 1);
  const auto store = std::make_shared<detail::GradientStore>(structure.mesh(), order, consumers);
  if (structure.keeps_all_rows()) {
    sweep(structure, *store, consumers, options, [&] { return KeptFaces(structure); });
  } else {
    const auto simplices = structure.mesh().simplices(needs_of(looked_up));
    sweep(structure, *store, consumers, options, [&] { return LookedUpFaces(simplices); });
  }
  store->finish();
  return DiscreteGradient(store);
}

}  // namespace gale
