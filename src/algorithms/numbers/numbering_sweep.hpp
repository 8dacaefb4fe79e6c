#pragma once

#include <algorithm>
#include <vector>

#include <gale/algorithms/numbers/later_star.hpp>
#include <gale/algorithms/numbers/number_queries.hpp>
#include <gale/algorithms/simplex_numbers.hpp>

namespace gale::detail {

/// A sweep of the owned vertices. It counts the edges and triangles that have each vertex as their first, the one with
/// the lowest input id, and finds the places of those asked for among these.
class NumberingSweep {
 public:
  using Counts = Array<Id, HostMemory>;

  /// `named` must outlive it; the first vertices of all are owned.
  NumberingSweep(Structure& structure, const NamedSimplices& named, const SweepOptions& options)
      : vertices_(structure.mesh().vertices()),
        input_(structure.mesh().vertex_input().data()),
        edges_(structure.mesh(), named.edges),
        triangles_(structure.mesh(), named.triangles),
        edge_counts_(allocate<Counts>("GALE::first_edges", vertices_ + 1)),
        triangle_counts_(allocate<Counts>("GALE::first_triangles", vertices_ + 1)),
        on_surface_(allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", vertices_)),
        large_(std::max(options.threads, 1)) {
    structure.for_each_segment(simplex_numbers_relations, options,
                               [this](int consumer, const SegmentRows& rows) { visit(consumer, rows); });
  }

  /// By input vertex, with room for one more. Those of ghosts mean nothing.
  const Counts& edge_counts() const { return edge_counts_; }
  const Counts& triangle_counts() const { return triangle_counts_; }

  NumberQueries<2>& edges() { return edges_; }
  NumberQueries<3>& triangles() { return triangles_; }

  /// By GALE's id.
  const Array<std::uint8_t, HostMemory>& on_surface() const { return on_surface_; }

 private:
  void visit(int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    Pending pending(edges_, triangles_, rows.segment());
    for (const Id v : rows.interval(Relation::VV)) {
      if (neighbours[v].size() <= SmallLink::capacity) {
        visit(v, SmallLaterStar(input_, v, neighbours[v], links[v]), pending);
      } else {
        large_[consumer].build(input_, v, neighbours[v], links[v]);
        visit(v, large_[consumer], pending);
      }
    }
  }

  /// The simplices of one segment whose places are still to be found, in the order of its vertices.
  struct Pending {
    Pending(const NumberQueries<2>& edges, const NumberQueries<3>& triangles, Id segment)
        : edge(edges.of(segment).begin()),
          last_edge(edges.of(segment).end()),
          triangle(triangles.of(segment).begin()),
          last_triangle(triangles.of(segment).end()) {
      std::sort(edge, last_edge);
      std::sort(triangle, last_triangle);
    }

    NumberQueries<2>::Query *edge, *last_edge;
    NumberQueries<3>::Query *triangle, *last_triangle;
  };

  template <class LaterStar>
  void visit(Id v, const LaterStar& star, Pending& pending) {
    edge_counts_(input_[v]) = star.edges();
    triangle_counts_(input_[v]) = star.triangles();
    on_surface_(v) = star.on_surface();
    for (; pending.edge != pending.last_edge && pending.edge->vertex == v; ++pending.edge) {
      const Id index = pending.edge->index;
      edges_.set_place(index, star.edge(edges_.ascending(index)[1]));
    }
    for (; pending.triangle != pending.last_triangle && pending.triangle->vertex == v; ++pending.triangle) {
      const Id index = pending.triangle->index;
      const auto vertices = triangles_.ascending(index);
      triangles_.set_place(index, star.triangle(vertices[1], vertices[2]));
    }
  }

  Id vertices_;
  const Id* input_;
  NumberQueries<2> edges_;
  NumberQueries<3> triangles_;
  Counts edge_counts_, triangle_counts_;
  Array<std::uint8_t, HostMemory> on_surface_;
  std::vector<LargeLaterStar> large_;
};

}  // namespace gale::detail
