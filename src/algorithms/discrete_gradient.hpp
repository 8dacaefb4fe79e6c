#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/runtime/computation.hpp>

namespace gale {

namespace detail {
class GradientStore;

/// Where successors are on the host; null as long as nobody asked for them there.
struct HostSuccessors {
  std::atomic<const Id*> vertex{nullptr}, cell{nullptr};
};
}  // namespace detail

/// What a simplex is paired with: another of one dimension less or more, which has one vertex less or more.
struct Partner {
  int dimension;  ///< the other simplex's dimension; -1 if there is none: the simplex is critical
  Id vertex;      ///< the vertex in which the two differ

  /// Whether there is no other: the simplex is critical, and `vertex` says nothing.
  bool is_critical() const { return dimension < 0; }
};

/// A discrete gradient: pairs of simplices whose dimensions differ by one (Forman 1998). Each simplex is in one pair at
/// most; those in none are critical. Immutable, for any number of threads; copies share the arrays. Where kernels found
/// it, it stays with them: each array comes to the host when somebody there first asks for it.
///
/// What it stores is what paths along the gradient ask for. Each vertex and each cell has its successor, 4 bytes. Each
/// vertex of a mesh of tetrahedra has a row of its edges to lower vertices, with the third vertex of the triangle that
/// each edge is paired with: 5 bytes an edge and 12 a vertex. Edges and triangles have no ids here: they are named by
/// their vertices (GALE's ids).
///
/// On a triangle mesh cells are triangles, and their successors say what edges are paired with: an edge's pair is found
/// among the triangles of a segment, in time O(capacity). To go through all pairs ask each vertex and each cell.
class GALE_EXPORT DiscreteGradient {
 public:
  /// For GALE's own algorithms; users have gradients from find_discrete_gradient.
  explicit DiscreteGradient(std::shared_ptr<const detail::GradientStore> store);

  /// The mesh that it is a gradient of.
  const Mesh& mesh() const;

  /// The order of the field that it descends.
  const VertexOrder& order() const;

  /// The simplices that it pairs with no other; on one rank's part of a mesh those whose highest vertex it owns.
  const CriticalSimplices& critical() const;

  /// How many critical simplices there are of each dimension, 0 to 3, on all ranks; of a triangle mesh none of the
  /// last.
  const std::array<GlobalId, 4>& counts() const;

  /// Alternating sum of these counts: the mesh's Euler characteristic.
  GlobalId euler() const { return counts()[0] - counts()[1] + counts()[2] - counts()[3]; }

  /// The next vertex on the falling path: the other end of the paired edge. no_id for a critical vertex.
  Id vertex_successor(Id vertex) const {
    const Id* const there = successors_->vertex.load(std::memory_order_acquire);
    return (there != nullptr ? there : fetch_vertex_successors())[vertex];
  }

  /// The next cell on the rising path: the tetrahedron across the paired triangle, or on a triangle mesh the triangle
  /// across the paired edge; of several, that of the lowest input id. no_id for a critical cell; below that if the path
  /// leaves through the mesh's boundary (`leaves`).
  Id cell_successor(Id cell) const {
    const Id* const there = successors_->cell.load(std::memory_order_acquire);
    return (there != nullptr ? there : fetch_cell_successors())[cell];
  }

  /// Whether a cell's successor says that the path leaves through the mesh's boundary.
  static bool leaves(Id successor) { return successor < no_id && successor != elsewhere; }

  /// In one rank's part of a mesh, the successor of a ghost, and of a cell whose highest vertex is a ghost: what
  /// it is the owner of that vertex knows. Edges and triangles with such a vertex have no pairs here.
  static constexpr Id elsewhere = std::numeric_limits<Id>::min();

  /// Third vertex of the triangle that the edge between two vertices, in any order, is paired with; no_id if it is with
  /// none. They must have an edge: nothing is checked.
  Id triangle_of_edge(Id a, Id b) const;

  /// What triangle_of_edge says, faster, of an edge whose higher end is known.
  Id triangle_of_lower_edge(Id high, Id low) const;

  /// Calls visit(low, third) for each edge (high, low) that is paired with a triangle (high, low, third) and has no
  /// vertex above `high`. In no order that means anything to users.
  void for_each_edge_pair(Id high, const std::function<void(Id low, Id third)>& visit) const;

  /// What a vertex is paired with. Here and below the simplices must be there: nothing is checked.
  Partner pair_of_vertex(Id vertex) const;

  /// What the edge between two vertices, in any order, is paired with.
  Partner pair_of_edge(Id a, Id b) const;

  /// What a cell is paired with.
  Partner pair_of_cell(Id cell) const;

  /// The pair of the triangle of a tetrahedron that is opposite the `corner`-th of its vertices (EncodedMesh's order).
  /// `others` has the other tetrahedra of that triangle. Throws gale::Error on a triangle mesh, where pair_of_cell says
  /// it.
  Partner pair_of_triangle(Id tetrahedron, int corner, const Row& others) const;

  /// vertex_successor of all vertices, by GALE's id. Several threads may refer to the View; copies of it are for one
  /// thread, as Kokkos counts them without atomics where it has Serial alone.
  const Array<const Id, HostMemory>& vertex_successors() const;

  /// cell_successor of all cells, by GALE's id. What is said of copies above holds.
  const Array<const Id, HostMemory>& cell_successors() const;

  /// The memory that it takes, in bytes.
  std::size_t bytes() const;

  /// For GALE's own algorithms.
  const detail::GradientStore& store() const { return *store_; }

 private:
  const Id* fetch_vertex_successors() const;
  const Id* fetch_cell_successors() const;

  std::shared_ptr<const detail::GradientStore> store_;
  detail::HostSuccessors* successors_;
};

/// The discrete gradient of a field, after Robins, Wood and Sheppard (2011): the lower star of each vertex is paired by
/// itself, so simplices are paired only with simplices that have the same highest vertex. Keys are unique: the result
/// depends on nothing but mesh and order.
///
/// By kernels where the mesh is on a device and they find room there, else by threads of the host: `options` may say
/// otherwise, and `computed` is told. The result is the same. On one rank's part of a mesh it has the pairs of the
/// simplices whose highest vertices the rank owns, and is collective; nothing is exchanged beside the counts. Throws
/// gale::Error as require_consumers, make_structure and sweeps do.
GALE_EXPORT DiscreteGradient find_discrete_gradient(const VertexOrder& order, const ComputeOptions& options = {},
                                                    Computed* computed = nullptr);

/// Finds it by threads of the host, in a sweep of VV, VT (VF on a triangle mesh) and link. Throws gale::Error if
/// `structure` isn't preconditioned for them, and if `order` is of another mesh than the structure's. No edge or
/// triangle is enumerated: beside the blocks of the sweep there is only the gradient in memory.
GALE_EXPORT DiscreteGradient find_discrete_gradient(Structure& structure, const VertexOrder& order,
                                                    const SweepOptions& options = {});

/// Finds it by kernels where the relations are made, where it stays; only the critical simplices come to
/// the host. Stars of more than 64 lower edges, 128 cells, or with a triangle of three tetrahedra are paired on the
/// host, and so are those of a triangle mesh with more than 64 edges, or with an edge of three triangles: if
/// there are any, all comes there. What is said of sweeps (device_sweep.hpp) holds. 4 bytes a vertex beside
/// the gradient and the blocks.
GALE_EXPORT DiscreteGradient find_discrete_gradient(const WorkerSpace& space, const VertexOrder& order,
                                                    const DeviceSweepOptions& options = {});

/// What the sweep of a mesh whose cells have that dimension reads.
KOKKOS_FUNCTION constexpr RelationSet discrete_gradient_relations_of(int dimension) {
  return star_relations_of(dimension);
}

/// What the sweep of a mesh of tetrahedra reads.
inline constexpr RelationSet discrete_gradient_relations = discrete_gradient_relations_of(3);

}  // namespace gale
