#include <algorithm>

#include <gale/algorithms/numbers/later_star.hpp>
#include <gale/algorithms/numbers/number_queries.hpp>
#include <gale/algorithms/order/whole_mesh.hpp>
#include <gale/algorithms/simplex_numbers.hpp>

namespace gale {

namespace {

using HostSpace = Kokkos::DefaultHostExecutionSpace;
using Ids = Array<Id, HostMemory>;

/// The sweep. It counts the edges and triangles that have each vertex as their first, and finds the places of those
/// asked for among them.
class Numbering {
 public:
  Numbering(const Mesh& mesh, const NamedSimplices& named, int consumers)
      : vertices_(mesh.vertices()),
        input_(mesh.vertex_input().data()),
        edges_(mesh, named.edges),
        triangles_(mesh, named.triangles),
        edge_begin_(allocate<Ids>("GALE::first_edges", vertices_ + 1)),
        triangle_begin_(allocate<Ids>("GALE::first_triangles", vertices_ + 1)),
        on_surface_(allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", vertices_)),
        large_(consumers) {}

  void visit(int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    Pending pending(edges_, triangles_, rows.segment());
    for (const Id v : rows.interval(Relation::VV)) {
      if (neighbours[v].size() <= detail::SmallLink::capacity) {
        visit(v, detail::SmallLaterStar(input_, v, neighbours[v], links[v]), pending);
      } else {
        large_[consumer].build(input_, v, neighbours[v], links[v]);
        visit(v, large_[consumer], pending);
      }
    }
  }

  SimplexNumbers finish() {
    scan("edges", edge_begin_);
    scan("triangles", triangle_begin_);
    return {edges_.take_numbers(edge_begin_), triangles_.take_numbers(triangle_begin_), on_surface_};
  }

 private:
  /// The simplices of one segment whose places are still to be found, in the order of its vertices.
  struct Pending {
    Pending(const detail::NumberQueries<2>& edges, const detail::NumberQueries<3>& triangles, Id segment)
        : edge(edges.begin(segment)),
          last_edge(edges.end(segment)),
          triangle(triangles.begin(segment)),
          last_triangle(triangles.end(segment)) {
      std::sort(edge, last_edge);
      std::sort(triangle, last_triangle);
    }

    detail::NumberQueries<2>::Query *edge, *last_edge;
    detail::NumberQueries<3>::Query *triangle, *last_triangle;
  };

  template <class LaterStar>
  void visit(Id v, const LaterStar& star, Pending& pending) {
    edge_begin_(input_[v]) = star.edges();
    triangle_begin_(input_[v]) = star.triangles();
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

  /// Turns the counts into the number of each vertex's first simplex.
  void scan(const char* name, const Ids& begin) const {
    const auto count = [&](Offset i) { return begin(i); };
    require_ids(name, reduce_sum("GALE::sum_simplices", HostSpace(), vertices_, count));
    exclusive_scan("GALE::number_first_simplices", HostSpace(), vertices_, begin, count);
  }

  Id vertices_;
  const Id* input_;
  detail::NumberQueries<2> edges_;
  detail::NumberQueries<3> triangles_;
  Ids edge_begin_, triangle_begin_;  ///< by input vertex
  Array<std::uint8_t, HostMemory> on_surface_;
  std::vector<detail::LargeLaterStar> large_;
};

}  // namespace

SimplexNumbers number_simplices(Structure& structure, const NamedSimplices& named, const SweepOptions& options) {
  detail::require_whole_mesh("the numbers of simplices", structure.mesh());
  const ThreadLimit limit(options.threads);
  Numbering numbering(structure.mesh(), named, std::max(options.threads, 1));
  structure.for_each_segment(simplex_numbers_relations, options,
                             [&](int consumer, const SegmentRows& rows) { numbering.visit(consumer, rows); });
  return numbering.finish();
}

}  // namespace gale
