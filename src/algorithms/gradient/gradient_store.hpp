#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/algorithms/vertex_order.hpp>

namespace gale::detail {

/// What a DiscreteGradient is made of, and how the consumers of a sweep fill it: each vertex is one consumer's, and
/// with it all simplices that have it as their highest vertex.
class GradientStore {
 public:
  /// Throws gale::Error if the order is of another mesh.
  GradientStore(const Mesh& mesh, const VertexOrder& order, int consumers);

  /// Pairs a vertex with the edge to `other`; no_id if the vertex is critical.
  void set_vertex(int consumer, Id vertex, Id other) {
    vertex_successor(vertex) = other;
    if (other == no_id) found_[consumer].vertices.push_back(vertex);
  }

  /// A row for the lower ends of a vertex's edges, to be filled in ascending order; no edge is paired yet.
  EdgePairRow begin_edges(int consumer, Id vertex, Id count) { return pairs.begin(consumer, vertex, count); }

  /// Sets the tetrahedron across the triangle that a tetrahedron is paired with, or `outside`.
  void set_tetrahedron(Id tetrahedron, Id successor) { tetrahedron_successor(tetrahedron) = successor; }

  /// Says that the triangle that a tetrahedron is paired with has a third tetrahedron, or one more, beside its
  /// successor.
  void add_successor(int consumer, Id tetrahedron, Id successor) {
    further_[consumer].push_back({tetrahedron, successor});
  }

  /// The successor of a tetrahedron that leaves through the surface, by the triangle opposite its corner.
  static Id outside(int corner) { return no_id - 1 - corner; }
  static int corner_outside(Id successor) { return no_id - 1 - successor; }

  void add_critical_edge(int consumer, Id high, Id low) { found_[consumer].edges.push_back({high, low}); }
  void add_critical_triangle(int consumer, const std::array<Id, 3>& from_high_to_low) {
    found_[consumer].triangles.push_back(from_high_to_low);
  }
  void add_critical_tetrahedron(int consumer, Id tetrahedron) {
    tetrahedron_successor(tetrahedron) = no_id;
    found_[consumer].tetrahedra.push_back(tetrahedron);
  }

  /// Adds a tetrahedron of a critical triangle.
  void add_to_star(int consumer, const std::array<Id, 3>& triangle, Id tetrahedron) {
    stars_[consumer].push_back({triangle, tetrahedron});
  }

  /// After the sweep: gathers what the consumers found, in the order of input numbers.
  void finish();

  std::size_t bytes() const;

  const Mesh mesh;
  const VertexOrder order;
  Array<Id, HostMemory> vertex_successor;
  Array<Id, HostMemory> tetrahedron_successor;

  /// The same for readers, who may be on several threads: for them to refer to, not to copy.
  const Array<const Id, HostMemory> vertex_successors;
  const Array<const Id, HostMemory> tetrahedron_successors;

  EdgePairs pairs;
  CriticalSimplices critical;

  /// (tetrahedron, successor), ascending: where rising paths fork, at triangles of three tetrahedra or more, the
  /// successors that `tetrahedron_successor` hasn't.
  std::vector<std::pair<Id, Id>> further_successors;

 private:
  struct InStar {
    std::array<Id, 3> triangle;
    Id tetrahedron;
  };

  // What each consumer found.
  std::vector<CriticalSimplices> found_;
  std::vector<std::vector<InStar>> stars_;
  std::vector<std::vector<std::pair<Id, Id>>> further_;
};

}  // namespace gale::detail
