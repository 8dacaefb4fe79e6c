#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// A simplex as users write it: its input vertices, ascending. From GALE's ids.
template <class Names, class Simplex>
Simplex written(const Names& vertex_input, Simplex simplex) {
  for (Id& vertex : simplex) vertex = vertex_input[vertex];
  return ascending(simplex);
}

/// Sets the successor of the i-th simplex outside an interval to elsewhere.
template <class Memory>
struct MarkOutside {
  Array<Id, Memory> successor;
  Interval inner;

  KOKKOS_FUNCTION void operator()(Offset i) const { successor(inner.outside(i)) = DiscreteGradient::elsewhere; }
};

/// Sets the successors of what a sweep of a rank's part of a mesh leaves out to elsewhere, before it; of a mesh that is
/// no grid those of all cells.
template <class Space>
void mark_ghosts(const Space& space, const Mesh& mesh, const Array<Id, MemoryOf<Space>>& vertex_successor,
                 const Array<Id, MemoryOf<Space>>& cell_successor) {
  using Memory = MemoryOf<Space>;
  const Interval owned = mesh.owned_vertices();
  if (owned.size() == mesh.vertices()) return;
  const Interval inner = mesh.grid() == nullptr ? Interval{0, 0} : mesh.grid()->cells_within(owned);
  parallel_for("GALE::mark_ghosts", space, mesh.vertices() - owned.size(),
               MarkOutside<Memory>{vertex_successor, owned});
  parallel_for("GALE::mark_ghosts", space, mesh.cells() - inner.size(), MarkOutside<Memory>{cell_successor, inner});
}

/// A cell of a critical simplex of one dimension less: of a triangle, or of an edge, whose third vertex is no_id.
struct InStar {
  std::array<Id, 3> simplex;
  Id cell;
};

/// Critical simplices as they are found, in no order; from the highest vertex to the lowest.
template <template <class> class List>
struct FoundSimplices {
  List<Id> vertices;
  List<std::array<Id, 2>> edges;
  List<std::array<Id, 3>> triangles;
  List<Id> cells;
  List<InStar> stars;
};

/// Calls visit(list, other) for the lists of one and what another has for each.
template <class One, class Other, class Visit>
void for_each_list(One& one, Other& other, const Visit& visit) {
  visit(one.vertices, other.vertices);
  visit(one.edges, other.edges);
  visit(one.triangles, other.triangles);
  visit(one.cells, other.cells);
  visit(one.stars, other.stars);
}

template <class T>
using HostList = std::vector<T>;

template <class T>
void append(std::vector<T>& list, const T& item) {
  list.push_back(item);
}

/// Where pair_star puts what it finds at a vertex, with which go all simplices that have it as their highest one.
template <class Found>
struct StarSink {
  Id *vertex_successor, *cell_successor;
  Found* found;

  /// Pairs a vertex with the edge to `other`; no_id if the vertex is critical.
  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void set_vertex(Id vertex, Id other) const {
    vertex_successor[vertex] = other;
    if (other == no_id) append(found->vertices, vertex);
  }

  /// Sets the cell across the facet that a cell is paired with, or `outside`.
  KOKKOS_FORCEINLINE_FUNCTION void set_cell(Id cell, Id successor) const { cell_successor[cell] = successor; }

  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_edge(Id high, Id low) const {
    append(found->edges, std::array<Id, 2>{high, low});
  }
  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_triangle(const std::array<Id, 3>& triangle) const {
    append(found->triangles, triangle);
  }
  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_cell(Id cell) const {
    cell_successor[cell] = no_id;
    append(found->cells, cell);
  }

  /// Adds a cell of a critical simplex of one dimension less, see InStar.
  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void add_to_star(const std::array<Id, 3>& simplex, Id cell) const {
    append(found->stars, InStar{simplex, cell});
  }
};

/// What one consumer on the host finds.
struct ConsumerFound : FoundSimplices<HostList> {
  std::vector<std::pair<Id, Id>> further_successors;  ///< see GradientStore
};

/// Where a consumer on the host puts it.
struct ConsumerSink : StarSink<ConsumerFound> {
  EdgePairs* pairs;
  int consumer;

  /// A row for the lower ends of a vertex's edges, to be filled in ascending order; no edge is paired yet.
  EdgePairRow begin_edges(Id vertex, Id count) const { return pairs->begin(consumer, vertex, count); }

  /// Says that the simplex that a cell is paired with has a third cell, or one more, beside its successor.
  void add_successor(Id cell, Id successor) const { found->further_successors.push_back({cell, successor}); }
};

/// What kernels found.
struct DeviceGradient {
  Array<Id, WorkerMemory> vertex_successor, cell_successor;
  Array<Id, WorkerMemory> pair_words;       ///< the words of EdgePairRows; none of a triangle mesh
  Array<Offset, WorkerMemory> pairs_begin;  ///< where each vertex's row begins among them
  ConsumerFound critical;
};

/// The successors of vertices as the host reads them: a grid's codes have them, too, so that they needn't come from a
/// device. Owns nothing.
struct VertexSteps {
  const Id* all = nullptr;
  const GridCodes* codes = nullptr;

  Id operator[](Id vertex) const { return codes != nullptr ? codes->successor(vertex) : all[vertex]; }

  /// Brings what is soon read near.
  void prefetch(Id vertex) const {
    if (codes == nullptr) __builtin_prefetch(all + vertex);
  }
};

/// What a DiscreteGradient is made of, and how the consumers of a sweep fill it. One that kernels found stays on the
/// device; each part comes to the host when somebody there first asks for it. Of a triangle mesh the successors are all
/// of it: an edge is paired with a vertex or a triangle, which has it as its own.
class GALE_EXPORT GradientStore {
 public:
  /// For consumers on the host. Throws gale::Error if the order is of another mesh.
  GradientStore(const Mesh& mesh, const VertexOrder& order, int consumers);

  /// What kernels found, complete.
  GradientStore(const VertexOrder& order, const DeviceGradient& found);

  /// Knows only which simplices are critical, in the order of input numbers; complete. The successors of all others are
  /// elsewhere, and vertices have no edges in their rows, which are made when somebody first asks for them.
  GradientStore(const VertexOrder& order, CriticalSimplices known);

  /// Makes a store on the host from what kernels found, for consumers to add the vertices that kernels left out.
  static std::shared_ptr<GradientStore> on_host(const VertexOrder& order, const DeviceGradient& found, int consumers);

  ConsumerSink sink(int consumer) {
    return {{consumed_vertices_.data(), consumed_cells_.data(), &found_[consumer]}, &pairs_, consumer};
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
  const Mirrored<Id>& cell_successors() const { return cell_successors_; }
  const EdgePairs& pairs() const;
  VertexSteps vertex_steps() const;

  /// Begins to bring what pairs() reads to the host, where kernels found it.
  void bring_pairs_to_host() const;

  /// Whether kernels found it, of a mesh of tetrahedra. Then these are the words of EdgePairRows, and where each
  /// vertex's row begins among them.
  bool is_from_kernels() const { return pairs_begin_.size() != 0; }
  const Mirrored<Id>& pair_words() const { return pair_words_; }
  const Mirrored<Offset>& pairs_begin() const { return pairs_begin_; }

  /// Codes of all vertices (PairCode), which say the same of a grid that has all its cubes in a sixth of these words:
  /// made when somebody first asks for them, and kept, which bytes() doesn't count. `for_kernels` alone they are made
  /// where kernels run or not at all: throws OutOfMemory, and a later call tries again.
  bool has_codes() const { return is_from_kernels() && mesh.grid() != nullptr && mesh.grid()->is_whole(); }
  const Mirrored<std::uint64_t>& codes(bool for_kernels = false) const;

  /// For DiscreteGradient, which looks them up often.
  mutable HostSuccessors host_successors;

  CriticalSimplices critical;
  std::array<GlobalId, 4> counts{};  ///< of critical simplices
  /// (cell, successor), ascending: where rising paths fork, at simplices of three cells or more, the successors that
  /// `cell_successor` hasn't.
  std::vector<std::pair<Id, Id>> further_successors;

 private:
  void count_critical();

  Array<Id, HostMemory> consumed_vertices_, consumed_cells_;  // successors, which consumers fill
  Mirrored<Id> vertex_successors_, cell_successors_;
  Mirrored<Id> pair_words_;
  Mirrored<Offset> pairs_begin_;
  bool are_pairs_consumers_ = false;  ///< whether consumers fill `pairs_`: else it is made when it is asked for
  OnceMade<Mirrored<std::uint64_t>> codes_;
  mutable EdgePairs pairs_;
  mutable Once pairs_are_here_;
  std::vector<ConsumerFound> found_;  ///< by each consumer
};

}  // namespace gale::detail
