#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/runtime/structure.hpp>
#include <gale/ttk/cell_order.hpp>
#include <gale/ttk/per_thread.hpp>
#include <gale/ttk/reader.hpp>

namespace gale::ttk {

/// How rows are computed and kept.
struct Options {
  StructureOptions structure;  ///< its host_memory is 512 MiB by default, since the blocks are kept translated
  int capacity = 100;          ///< vertices of a segment, at most
  std::size_t memory = 0;  ///< bytes for translated blocks; by default 192 a vertex, which VV and VT take, and 16 MiB
};

/// A caller's points: three coordinates each, float or double.
struct CallersPoints {
  const void* coordinates = nullptr;
  Id count = 0;
  bool in_double = false;
};

/// What TTK asks of a triangulation, in TTK's ids and in the order of TTK's explicit triangulation: vertices and cells
/// have the caller's numbers, edges and triangles those of `CellOrder`. Rows of edges, triangles and cells ascend;
/// neighbours are in the order of the edges, or triangles, to them.
///
/// One thread says first what will be read (need_...); then any threads read. What is returned stays valid until the
/// same thread asks the same again. To read rows that nobody needed throws gale::Error; all else that nobody needed
/// must not be read.
class GALE_EXPORT Connectivity {
 public:
  /// Segments and encodes. Throws as octree_segmentation and Mesh do.
  Connectivity(const CallersPoints& points, const Cells& cells, const Options& options);
  ~Connectivity();

  const Mesh& mesh() const { return mesh_; }
  const Cells& cells() const { return cells_; }

  /// Of edges and triangles no_id as long as nobody needed them.
  Id count(int dimension) const { return counts_[dimension]; }

  void need_edges();
  void need_triangles();

  /// One of VV, VT, VE, VF, ET, EF and FT.
  void need_rows(Relation relation);

  /// on_surface() of vertices (0), edges (1) or triangles (2). Where VV is needed, too, say that first: the sweep that
  /// finds the vertices keeps its rows then.
  void need_surface(int dimension);

  /// Makes what computes rows. Otherwise the first to read does it, with whatever threads it has.
  void prepare() { structure(); }

  /// What was done for rows since some were last said to be needed; of the consumers, those that have ended.
  StructureStatistics statistics() { return structure().statistics(); }

  template <Relation relation>
  Row row(Id simplex) const {
    Reader& mine = reader();
    Reading& reading = mine.readings[static_cast<int>(relation)];
    if (reading.simplex != simplex) {
      const Id* const internal = internal_[row_dimension(relation)];
      if (internal == nullptr) refuse(relation);
      const Id id = internal[simplex];
      if (!reading.held.has(id)) load(mine, relation, id);
      reading.simplex = simplex;
      reading.row = reading.rows[id];
    }
    return reading.row;
  }

  /// Vertices, ascending.
  const std::array<Id, 2>& edge(Id edge) const {
    return reader().edge.of(edge, [this](Id wanted) { return vertices_of<Relation::EV, 2>(edges_.internal(wanted)); });
  }
  const std::array<Id, 3>& triangle(Id triangle) const {
    return reader().triangle.of(
        triangle, [this](Id wanted) { return vertices_of<Relation::FV, 3>(triangles_.internal(wanted)); });
  }

  /// Ascending.
  const std::array<Id, 3>& triangle_edges(Id triangle) const;

  /// As TTK lists a cell's edges and triangles.
  const std::array<Id, 6>& cell_edges(Id cell) const;
  const std::array<Id, 4>& cell_triangles(Id cell) const;

  /// The cells behind those of a cell's triangles that have two. Reads FT.
  Row cell_neighbours(Id cell) const;

  /// What is opposite to a simplex in the i-th cell of its star: a triangle, an edge, a vertex. Reads VT, ET, FT.
  Id vertex_link(Id vertex, Id i) const;
  Id edge_link(Id edge, Id i) const;
  Id triangle_link(Id triangle, Id i) const;

  bool on_surface(int dimension, Id simplex) const { return on_surface_[dimension](simplex) != 0; }

  /// Whether all triangles have one or two tetrahedra; those must be needed.
  bool is_manifold() const;

  /// Of tables and blocks, beside the mesh and its simplices.
  std::size_t bytes() const;

 private:
  Reader& reader() const {
    return readers_->here([this] { return std::make_unique<Reader>(*store_); });
  }

  template <Relation relation, std::size_t n>
  std::array<Id, n> vertices_of(Id simplex) const;

  [[noreturn]] static void refuse(Relation relation);
  void load(Reader& reader, Relation relation, Id id) const;
  Block make_block(Reader& reader, Relation relation, Id segment) const;
  Id segment_of(int dimension, Id id) const;
  const Id* numbers_of(int dimension) const;
  Structure& structure() const;
  std::array<Id, 4> corners_of(Id cell) const;
  void sweep_stars(const Array<std::uint8_t, HostMemory>& on_surface);
  void find_surface_of_edges();
  void set_numbers(int dimension, const CellOrder& order);

  const Cells cells_;
  const Options options_;
  const Mesh mesh_;
  RelationSet wanted_rows_;  ///< by callers
  RelationSet wanted_;       ///< of the structure
  Array<Id, HostMemory> segment_of_vertex_;
  std::array<Id, 4> counts_;
  std::array<const Id*, 3> internal_{};  ///< TTK's id -> GALE's, by dimension
  const Id* vertex_input_;
  CellOrder edges_, triangles_;
  Array<std::uint8_t, HostMemory> tetrahedra_of_;              ///< by triangle: how many, at most 3
  std::array<Array<std::uint8_t, HostMemory>, 3> on_surface_;  ///< by dimension
  Simplices<HostMemory> simplices_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<Structure> structure_;
  std::unique_ptr<BlockStore> store_;
  std::unique_ptr<PerThread<Reader>> readers_;  ///< gone before the store and the structure
};

template <Relation relation, std::size_t n>
std::array<Id, n> Connectivity::vertices_of(Id simplex) const {
  const auto row = face_row<relation>(simplices_, simplex);
  std::array<Id, n> vertices;
  for (std::size_t i = 0; i < n; ++i) {
    const Id vertex = vertex_input_[row[static_cast<int>(i)]];
    std::size_t at = i;
    for (; at > 0 && vertices[at - 1] > vertex; --at) vertices[at] = vertices[at - 1];
    vertices[at] = vertex;
  }
  return vertices;
}

}  // namespace gale::ttk
