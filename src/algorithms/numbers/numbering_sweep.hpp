#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gale/algorithms/numbers/later_star.hpp>
#include <gale/algorithms/numbers/numbering.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Simplices of N vertices whose numbers are asked for. Each belongs to its first vertex, the one with the lowest input
/// id, and is found by that vertex's segment.
template <std::size_t N>
class NumberQueries {
 public:
  using Simplex = std::array<Id, N>;

  /// A simplex by its place in `simplices`, and its first vertex.
  struct Query {
    Id vertex, index;
    bool operator<(const Query& other) const { return vertex < other.vertex; }
  };

  /// `simplices` must outlive it. Throws gale::Error for a vertex that the mesh doesn't have.
  NumberQueries(const Mesh& mesh, const std::vector<Simplex>& simplices)
      : simplices_(simplices), input_(mesh.vertices_in_input()), numbers_(simplices.size()) {
    require_ids("simplices to number", simplices.size());
    const auto count = static_cast<Offset>(simplices.size());
    const Kokkos::DefaultHostExecutionSpace host;
    const auto by_segment = group_by_key<Id>("GALE::number_queries", host, count, mesh.segments(), [&](Id i) {
      require_vertices(mesh, simplices[i]);
      return mesh.segment_of(0, ascending(i)[0]);
    });
    queries_ = {by_segment.offsets, allocate<Array<Query, HostMemory>>("GALE::number_queries", count)};
    parallel_for("GALE::fill_number_queries", host, count, [&](Offset i) {
      const Id index = by_segment.entries(i);
      queries_.entries(i) = {ascending(index)[0], index};
    });
  }

  /// The queries of a segment, in no order.
  Span<Query> of(Id segment) const { return queries_.row(segment); }

  /// The vertices of a simplex (GALE's), by ascending input id.
  Simplex ascending(Offset index) const {
    Simplex simplex = simplices_[index];
    std::sort(simplex.begin(), simplex.end(), [this](Id a, Id b) { return input_[a] < input_[b]; });
    return simplex;
  }

  /// Sets the place of a simplex among those with the same first vertex. Throws gale::Error if it is no_id.
  void set_place(Id index, Id place) {
    if (place == no_id) refuse_simplex(input_, ascending(index));
    numbers_[index] = place;
  }

  /// The place of a simplex, when it is set.
  GlobalId place(Offset index) const { return numbers_[index]; }

  /// When all places are set: the numbers, from those of the first simplex of each input vertex.
  std::vector<GlobalId> take_numbers(const Array<Id, HostMemory>& begin) {
    const auto& all = queries_.entries;
    parallel_for("GALE::add_numbers", Kokkos::DefaultHostExecutionSpace(), numbers_.size(),
                 [&](Offset i) { numbers_[all(i).index] += begin(input_[all(i).vertex]); });
    return std::move(numbers_);
  }

 private:
  const std::vector<Simplex>& simplices_;
  OtherIds input_;
  Csr<Query, HostMemory, Id> queries_;  ///< by segment
  std::vector<GlobalId> numbers_;
};

/// A sweep of the owned vertices. It counts the edges and triangles that have each vertex as their first, the one with
/// the lowest input id, and finds the places of those asked for among these.
class NumberingSweep {
 public:
  using Counts = Array<Id, HostMemory>;

  /// `named` must outlive it; the first vertices of all are owned.
  NumberingSweep(Structure& structure, const NamedSimplices& named, const SweepOptions& options)
      : vertices_(structure.mesh().vertices()),
        input_(structure.mesh().vertices_in_input()),
        edges_(structure.mesh(), named.edges),
        triangles_(structure.mesh(), named.triangles),
        edge_counts_(allocate<Counts>("GALE::first_edges", vertices_ + 1)),
        triangle_counts_(allocate<Counts>("GALE::first_triangles", vertices_ + 1)),
        on_surface_(allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", vertices_)),
        large_(std::max(options.threads, 0)) {
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
  OtherIds input_;
  NumberQueries<2> edges_;
  NumberQueries<3> triangles_;
  Counts edge_counts_, triangle_counts_;
  Array<std::uint8_t, HostMemory> on_surface_;
  std::vector<LargeLaterStar> large_;
};

}  // namespace gale::detail
