#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include <gale/mesh/mesh.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/ttk/cell_order.hpp>
#include <gale/ttk/per_thread.hpp>
#include <gale/ttk/reader.hpp>
#include <gale/ttk/segments.hpp>

namespace gale::ttk {

/// How rows are computed and kept.
struct Options {
  StructureOptions structure;       ///< its host_memory is 128 MiB by default, since the blocks are kept translated
  int capacity = default_capacity;  ///< vertices of a segment, at most
  std::size_t memory = 0;  ///< bytes for translated blocks; by default 192 a vertex, which VV and VT take; where other
                           ///< rows are needed 40 to 192, by what all threads go through at one time; no bound where
                           ///< the numbers of vertices or cells don't follow places
};

/// A caller's points: three coordinates each, float or double.
struct CallersPoints {
  const void* coordinates = nullptr;
  Id count = 0;
  bool in_double = false;
};

/// What TTK asks of a triangulation, in TTK's ids and in the order of TTK's explicit triangulation: vertices and cells
/// have the caller's numbers, edges and triangles those of `CellOrder`. Rows of edges, triangles and cells ascend;
/// neighbours are in the order of the edges, or triangles, to them. Where cells are triangles, these have the cells'
/// numbers and corners, and what is said of T holds for F.
///
/// One thread says first what will be read (need_...); then any threads read. What is returned stays valid until the
/// same thread asks the same again. To read rows that nobody needed throws gale::Error; all else that nobody needed
/// must not be read.
class GALE_EXPORT Connectivity {
 public:
  /// Segments and encodes. Throws as octree_segmentation and Mesh do.
  Connectivity(const CallersPoints& points, const Cells& cells, const Options& options);
  ~Connectivity();

  const Cells& cells() const { return cells_; }

  /// How many simplices of a dimension there are: no_id for edges and triangles as long as nobody needed them.
  Id count(int dimension) const { return counts_[dimension]; }

  /// The dimension of the cells, and that of their facets.
  int dimension() const { return cells_.dimension(); }
  int facet_dimension() const { return dimension() - 1; }

  /// The edges (1) or the triangles (2).
  void need(int dimension);

  /// One of VV, VT, VE, VF, ET, EF and FT. Throws gale::Error for FT where cells are triangles.
  void need_rows(Relation relation);

  /// on_surface() of vertices (0), edges (1) or triangles (2). Where VV is needed, too, say that first: the sweep that
  /// finds the vertices keeps its rows then. Vertices without VV wait for the facets, and are found in a sweep of
  /// their own if they are read before these are needed.
  void need_surface(int dimension);

  template <Relation relation>
  Row row(Id simplex) const {
    if constexpr (relation == Relation::VF || relation == Relation::EF) {
      if (dimension() == 2) return row < relation == Relation::VF ? Relation::VT : Relation::ET > (simplex);
    }
    if constexpr (relation == Relation::FT || relation == Relation::ET) {
      if (relation == Relation::FT || dimension() == 2) {
        const CellOrder& facets = relation == Relation::FT ? triangles_ : edges_;
        if (!facets.is_there()) refuse(relation);
        const Id second = facets.second[simplex];
        if (second != CellOrder::crowded) {
          const auto& star = reader().star_of_facet.of(simplex, [&facets, second](Id wanted) {
            return std::array<Id, 2>{facets.met[wanted].cell, second};
          });
          return {star.data(), second == no_id ? 1 : 2};
        }
      }
    }
    const LastRow& last = last_row<relation>();
    return last.key == key_of(simplex) ? last.row : read<relation>(simplex);
  }

  /// Vertices, ascending; of a triangle that is a cell as the caller has them.
  const std::array<Id, 2>& edge(Id edge) const {
    return reader().edge.of(edge, [this](Id wanted) { return part_of_cell(edges_, edge_corners, wanted); });
  }
  const std::array<Id, 3>& triangle(Id triangle) const {
    return reader().triangle.of(triangle, [this](Id wanted) {
      if (dimension() == 3) return part_of_cell(triangles_, triangle_corners, wanted);
      return std::array<Id, 3>{cells_.vertex(wanted, 0), cells_.vertex(wanted, 1), cells_.vertex(wanted, 2)};
    });
  }

  /// Ascending; of a triangle that is a cell as TTK lists them.
  const std::array<Id, 3>& triangle_edges(Id triangle) const;

  /// As TTK lists a cell's edges and triangles. A triangle has three edges, and no triangles.
  const std::array<Id, 6>& cell_edges(Id cell) const;
  const std::array<Id, 4>& cell_triangles(Id cell) const;

  /// The cells behind those of a cell's facets that have two. Reads FT, or ET of triangles.
  Row cell_neighbours(Id cell) const;

  /// What is opposite to a simplex in the i-th cell of its star: of vertices, edges and triangles the triangle, the
  /// edge and the vertex in a tetrahedron, of vertices and edges the edge and the vertex in a triangle. Reads VT, ET,
  /// FT.
  template <Relation relation, std::size_t n>
  Id link(Id simplex, const std::array<Id, n>& vertices, Id i) const {
    const Id cell = row<relation>(simplex)[i];
    return simplex_at(cell, cells_.others(cell, vertices));
  }

  bool on_surface(int dimension, Id simplex) const {
    const std::uint8_t* flags = surface_flags_[dimension].load(std::memory_order_acquire);
    if (flags == nullptr) flags = late_surface(dimension);
    return (flags[simplex / 8] >> simplex % 8 & 1) != 0;
  }

  /// Whether all facets have one or two cells; those must be needed.
  bool is_manifold() const { return !facets().any_crowded; }

  /// Blocks computed so far: those of the segments that were read, and again what was dropped meanwhile.
  std::size_t blocks_made() const { return blocks_made_.load(std::memory_order_relaxed); }

  /// Bytes of tables and blocks, beside the mesh and its simplices.
  std::size_t bytes() const;

 private:
  Reader& reader() const {
    return readers_->here([this] { return std::make_unique<Reader>(*store_); });
  }

  /// The row that a thread read last, of any triangulation: found without a look at what else the thread has. It stays
  /// valid as long as it is found, since its block is left by read() alone, on the same thread, which forgets it first;
  /// and no number of readers is given twice.
  struct LastRow {
    std::uint64_t key = 0;
    Row row;
  };
  template <Relation relation>
  static LastRow& last_row() {
    static thread_local LastRow last;
    return last;
  }
  std::uint64_t key_of(Id simplex) const { return readers_number_ << 31 | static_cast<std::uint32_t>(simplex); }

  void renew_readers() {
    readers_ = std::make_unique<PerThread<Reader>>();
    readers_number_ = readers_->number();
  }

  template <Relation relation>
  Row read(Id simplex) const;

  template <std::size_t n, std::size_t parts>
  std::array<Id, n> part_of_cell(const CellOrder& order, const int (&corners)[parts][n], Id simplex) const;

  /// A simplex and its lowest vertex, in GALE's ids.
  struct Internal {
    Id id, lowest;
  };

  /// By TTK's id. Of edges and triangles a search among those of the lowest vertex.
  template <int dimension>
  Internal internal(Relation relation, Id simplex) const {
    if constexpr (dimension == 0) return {vertex_internal_[simplex], vertex_internal_[simplex]};
    return internal_by_vertices(relation, simplex);
  }

  /// What the mesh calls a relation to cells.
  Relation in_mesh(Relation relation) const {
    if (dimension() == 3) return relation;
    return relation == Relation::VT ? Relation::VF : relation == Relation::ET ? Relation::EF : relation;
  }

  const CellOrder& facets() const { return dimension() == 2 ? edges_ : triangles_; }

  [[noreturn]] void refuse(Relation relation) const;
  Internal internal_by_vertices(Relation relation, Id simplex) const;
  void load(Reader& reader, Relation relation, Id id, Id lowest) const;
  void look_ahead(Reader& reader, Relation relation, Id vertex) const;
  Block make_block(Reader& reader, Relation relation, Id segment) const;
  template <std::size_t n>
  std::array<Id, n> sorted_internal(std::array<Id, n> vertices) const;
  std::array<Id, 3> edges_of_triangle(Id triangle) const;
  Id simplex_at(Id cell, unsigned corners) const;

  /// What computes VV, and what all other rows. Each is made when it is first read from.
  struct Source {
    RelationSet wanted;
    std::unique_ptr<Structure> structure;
  };
  void need_mesh();
  void set_segments(const Segments& segments);
  std::shared_ptr<StarRows> new_stars() const;
  bool finds_in_cells(Relation relation) const {
    return finds_stars_in_cells_ && (relation == Relation::VV || relation == Relation::VT);
  }
  static int source_of(Relation relation) { return relation == Relation::VV ? 0 : 1; }
  Structure& structure(int source) const;
  bool is_by_place(int dimension) const;
  std::size_t default_memory() const;

  /// A bit each.
  using Flags = Array<std::uint8_t, HostMemory>;
  Flags no_flags(int dimension) const;
  static void set_flag(const Flags& flags, Id simplex) {  // by several threads
    __atomic_fetch_or(&flags.data()[simplex / 8], static_cast<std::uint8_t>(1u << simplex % 8), __ATOMIC_RELAXED);
  }
  Flags find_surface_in_sweep();
  void sweep_cells(const Flags& on_surface, bool keep) const;
  void sweep_structure(const Flags& on_surface);
  Flags surface_from_facets(int dimension) const;
  void set_surface(int dimension, const Flags& flags) const;
  const std::uint8_t* late_surface(int dimension) const;

  const Cells cells_;
  const Options options_;
  const Segmentation segmentation_;
  std::optional<const Mesh> mesh_;  ///< where VV and VT are found in the cells, when something else is needed
  bool finds_stars_in_cells_;       ///< VV and VT, rather than by a structure
  mutable Segments segments_;
  RelationSet wanted_rows_;  ///< by callers
  std::array<Id, 4> counts_;
  const Id* vertex_internal_;
  const Id* vertex_input_;
  CellOrder edges_, triangles_;
  mutable std::array<std::optional<bool>, 2> by_place_;  ///< the vertices, the cells; as soon as it is asked
  mutable std::atomic<std::size_t> blocks_made_{0};
  bool surface_waits_ = false;               ///< that of vertices, for the facets
  mutable std::array<Flags, 3> on_surface_;  ///< by dimension, and the same for readers
  mutable std::array<std::atomic<const std::uint8_t*>, 3> surface_flags_{};
  Simplices<HostMemory> simplices_;
  mutable std::mutex mutex_;
  mutable std::array<Source, 2> sources_;
  std::unique_ptr<BlockStore> store_;
  std::uint64_t readers_number_ = 0;
  std::unique_ptr<PerThread<Reader>> readers_;  ///< gone before the store and the structures
};

/// The row of another simplex than the last time: apart from row(), which is called for each entry.
template <Relation relation>
__attribute__((noinline)) Row Connectivity::read(Id simplex) const {
  LastRow& last = last_row<relation>();
  Reader& reader = this->reader();
  Reading& reading = reader.readings[static_cast<int>(relation)];
  const auto [id, lowest] = internal<row_dimension(relation)>(relation, simplex);
  if (!reading.now.has(id)) {
    last.key = 0;  // its block is let go
    load(reader, relation, id, lowest);
  }
  last = {key_of(simplex), reading.now.rows[id]};
  if constexpr (row_dimension(relation) == 0) look_ahead(reader, relation, simplex);
  if constexpr (relation == Relation::VT) {
    for (const Id cell : last.row) cells_.prefetch(cell);
  }
  return last.row;
}

/// Has the next vertex's row fetched, and the block of one that follows.
inline void Connectivity::look_ahead(Reader& reader, Relation relation, Id vertex) const {
  constexpr Id ahead = 2;
  if (vertex >= counts_[0] - ahead) return;
  auto& [now, next] = reader.readings[static_cast<int>(relation)];
  const Id follows = vertex_internal_[vertex + 1], later = vertex_internal_[vertex + ahead];
  if (now.has(follows)) {
    now.prefetch(follows);
  } else if (next.has(follows)) {
    next.prefetch(follows);
  }
  if (now.has(later) || next.has(later)) return;
  if (BlockStore::Slot* const slot = store_->hold_present(relation, segments_.of(vertex + ahead))) {
    reader.leave(next);
    next = HeldBlock(*slot);
    __builtin_prefetch(next.rows.offsets + (later - next.rows.first));
  }
}

/// Vertices of an edge or a triangle, ascending: those of its first cell at some corners.
template <std::size_t n, std::size_t parts>
std::array<Id, n> Connectivity::part_of_cell(const CellOrder& order, const int (&corners)[parts][n], Id simplex) const {
  const auto [cell, place] = order.met[simplex];
  std::array<Id, n> vertices;
  for (std::size_t i = 0; i < n; ++i) {
    const Id vertex = cells_.vertex(cell, corners[place][i]);
    std::size_t at = i;
    for (; at > 0 && vertices[at - 1] > vertex; --at) vertices[at] = vertices[at - 1];
    vertices[at] = vertex;
  }
  return vertices;
}

}  // namespace gale::ttk
