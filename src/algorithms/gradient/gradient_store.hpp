#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/parallel.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// A tetrahedron of a critical triangle.
struct InStar {
  std::array<Id, 3> triangle;
  Id tetrahedron;
};

/// Before a sweep of a rank's part of a mesh: has all successors be elsewhere, so that they are for what it leaves out.
template <class Space>
void mark_ghosts(const Space& space, const Mesh& mesh, const Array<Id, MemoryOf<Space>>& vertex_successor,
                 const Array<Id, MemoryOf<Space>>& tetrahedron_successor) {
  if (mesh.owned_vertices() == mesh.vertices()) return;
  fill("GALE::mark_ghosts", space, vertex_successor, DiscreteGradient::elsewhere);
  fill("GALE::mark_ghosts", space, tetrahedron_successor, DiscreteGradient::elsewhere);
}

/// What kernels found.
struct DeviceGradient {
  Array<Id, WorkerMemory> vertex_successor, tetrahedron_successor;
  Array<Id, WorkerMemory> pair_words;       ///< the words of EdgePairRows
  Array<Offset, WorkerMemory> pairs_begin;  ///< where each vertex's row begins among them
  CriticalSimplices critical;               ///< in no order, without stars
  std::vector<InStar> stars;
};

/// What a DiscreteGradient is made of, and how the consumers of a sweep fill it: each vertex is one consumer's, and
/// with it all simplices that have it as their highest vertex. One that kernels found stays on the device; each part
/// comes to the host when somebody there first asks for it.
class GALE_EXPORT GradientStore {
 public:
  /// For consumers on the host. Throws gale::Error if the order is of another mesh.
  GradientStore(const Mesh& mesh, const VertexOrder& order, int consumers);

  /// What kernels found, complete.
  GradientStore(const VertexOrder& order, const DeviceGradient& found);

  /// Makes a store on the host from what kernels found, for consumers to add the vertices that kernels left out.
  static std::shared_ptr<GradientStore> on_host(const VertexOrder& order, const DeviceGradient& found, int consumers);

  /// Pairs a vertex with the edge to `other`; no_id if the vertex is critical.
  void set_vertex(int consumer, Id vertex, Id other) {
    consumed_vertices_(vertex) = other;
    if (other == no_id) found_[consumer].vertices.push_back(vertex);
  }

  /// A row for the lower ends of a vertex's edges, to be filled in ascending order; no edge is paired yet.
  EdgePairRow begin_edges(int consumer, Id vertex, Id count) { return pairs_.begin(consumer, vertex, count); }

  /// Sets the tetrahedron across the triangle that a tetrahedron is paired with, or `outside`.
  void set_tetrahedron(Id tetrahedron, Id successor) { consumed_tetrahedra_(tetrahedron) = successor; }

  /// Says that the triangle that a tetrahedron is paired with has a third tetrahedron, or one more, beside its
  /// successor.
  void add_successor(int consumer, Id tetrahedron, Id successor) {
    further_[consumer].push_back({tetrahedron, successor});
  }

  /// The corner opposite the triangle through which a tetrahedron leaves by a successor that `leaves` is true of.
  static int corner_outside(Id successor) { return no_id - 1 - successor; }

  void add_critical_edge(int consumer, Id high, Id low) { found_[consumer].edges.push_back({high, low}); }
  void add_critical_triangle(int consumer, const std::array<Id, 3>& from_high_to_low) {
    found_[consumer].triangles.push_back(from_high_to_low);
  }
  void add_critical_tetrahedron(int consumer, Id tetrahedron) {
    consumed_tetrahedra_(tetrahedron) = no_id;
    found_[consumer].tetrahedra.push_back(tetrahedron);
  }

  /// Adds a tetrahedron of a critical triangle.
  void add_to_star(int consumer, const std::array<Id, 3>& triangle, Id tetrahedron) {
    stars_[consumer].push_back({triangle, tetrahedron});
  }

  /// After the sweep: gathers what the consumers found, in the order of input numbers, and counts it.
  void finish();

  /// When it is finished on all ranks: the counts become those of all. Collective.
  void share_counts();

  std::size_t bytes() const;

  const Mesh mesh;
  const VertexOrder order;

  /// After `finish`, for readers, who may be on several threads: to refer to, not to copy. On the device, if kernels
  /// found them.
  const Mirrored<Id>& vertex_successors() const { return vertex_successors_; }
  const Mirrored<Id>& tetrahedron_successors() const { return tetrahedron_successors_; }
  const EdgePairs& pairs() const;

  /// Whether kernels found it. Then these are the words of EdgePairRows, and where each vertex's row begins among them.
  bool is_from_kernels() const { return pairs_begin_.size() != 0; }
  const Mirrored<Id>& pair_words() const { return pair_words_; }
  const Mirrored<Offset>& pairs_begin() const { return pairs_begin_; }

  /// For DiscreteGradient, which looks them up often.
  mutable HostSuccessors host_successors;

  CriticalSimplices critical;
  std::array<GlobalId, 4> counts{};  ///< of critical simplices

  /// (tetrahedron, successor), ascending: where rising paths fork, at triangles of three tetrahedra or more, the
  /// successors that `tetrahedron_successor` hasn't.
  std::vector<std::pair<Id, Id>> further_successors;

 private:
  Array<Id, HostMemory> consumed_vertices_, consumed_tetrahedra_;  // successors, which consumers fill
  Mirrored<Id> vertex_successors_, tetrahedron_successors_;
  Mirrored<Id> pair_words_;
  Mirrored<Offset> pairs_begin_;
  mutable EdgePairs pairs_;
  mutable Once pairs_are_here_;

  // What each consumer found.
  std::vector<CriticalSimplices> found_;
  std::vector<std::vector<InStar>> stars_;
  std::vector<std::vector<std::pair<Id, Id>>> further_;
};

/// Where a consumer puts what it finds at a vertex: see pair_star.
struct ConsumerSink {
  GradientStore& store;
  int consumer;

  EdgePairRow begin_edges(Id vertex, Id count) const { return store.begin_edges(consumer, vertex, count); }
  void set_vertex(Id vertex, Id other) const { store.set_vertex(consumer, vertex, other); }
  void set_tetrahedron(Id tetrahedron, Id successor) const { store.set_tetrahedron(tetrahedron, successor); }
  void add_successor(Id tetrahedron, Id successor) const { store.add_successor(consumer, tetrahedron, successor); }
  void add_critical_edge(Id high, Id low) const { store.add_critical_edge(consumer, high, low); }
  void add_critical_triangle(Id high, Id middle, Id low) const {
    store.add_critical_triangle(consumer, {high, middle, low});
  }
  void add_critical_tetrahedron(Id tetrahedron) const { store.add_critical_tetrahedron(consumer, tetrahedron); }
  void add_to_star(Id high, Id middle, Id low, Id tetrahedron) const {
    store.add_to_star(consumer, {high, middle, low}, tetrahedron);
  }
};

}  // namespace gale::detail
