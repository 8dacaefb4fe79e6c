#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/export.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/exchange.hpp>
#include <gale/mesh/grid.hpp>
#include <gale/mesh/intervals.hpp>
#include <gale/mesh/segmentation.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale {

/// The vertices of each cell, in input ids, as a caller has them, in host memory or the workers'.
template <int corners, class Index, class Memory>
using CellCorners = Kokkos::View<const Index* [corners], Kokkos::LayoutRight, Memory>;

/// Four vertices per tetrahedron.
template <class Index, class Memory>
using Tetrahedra = CellCorners<4, Index, Memory>;

/// Three vertices per triangle.
template <class Index, class Memory>
using Triangles = CellCorners<3, Index, Memory>;

/// What ids in GALE's numbering are in the input's, or the other way: a permutation, or, of a grid, the same. Owns
/// nothing.
struct OtherIds {
  const Id* table = nullptr;  ///< null where all ids stay

  /// The other id of a vertex or cell.
  KOKKOS_FORCEINLINE_FUNCTION Id operator[](Id id) const { return table == nullptr ? id : table[id]; }
  KOKKOS_FORCEINLINE_FUNCTION Id operator()(Id id) const { return (*this)[id]; }  ///< what [] says, as of a View
};

/// A mesh's cells, by their vertices, loaded or computed. Owns nothing.
struct CellReader {
  const Id* vertices = nullptr;  ///< four of each cell; null where `grid` computes them
  GridView grid;                 ///< what it is then

  /// The vertices of a cell, ascending; of a triangle the third one twice.
  KOKKOS_FORCEINLINE_FUNCTION Quad operator()(Id cell) const {
    return vertices == nullptr ? grid.cell(cell) : quad_at(vertices, cell);
  }
};

namespace detail {

/// Reads cells one after the other, for one thread: what those of one cube of a grid have in common is computed once.
class CellsInTurn {
 public:
  explicit CellsInTurn(const CellReader& cells) : cells_(cells) {}

  /// The vertices of a cell, as CellReader has them.
  Quad operator()(Id cell) {
    if (cells_.vertices != nullptr) return cells_(cell);
    const Id cube = cell / cells_.grid.cells_per_cube();
    if (cube != cube_) corners_ = cells_.grid.corners_of_cube(cube_ = cube);
    return cells_.grid.cell_of_cube(corners_, static_cast<int>(cell % cells_.grid.cells_per_cube()));
  }

 private:
  CellReader cells_;
  Id cube_ = no_id;
  Quad corners_{};
};

}  // namespace detail

/// A mesh of tetrahedra, or of triangles, encoded once so that the relations of any segment can be computed from it
/// alone (the paper's §4.3). These are its cells, and their dimension is its own.
///
/// Any set of tetrahedra is a mesh: it may have several components, isolated vertices, parts that touch in an edge or a
/// vertex only, and triangles with three and more tetrahedra. Any set of triangles is one likewise: boundaries, edges
/// with three triangles and more, vertices where fans meet. GALE numbers vertices and cells anew (`EncodedMesh`); the
/// permutations lead back to input ids. Immutable after construction, so any number of threads may use it; copies share
/// the arrays.
///
/// Its arrays lie in the workers' memory, or in the host's where they don't fit that. Accessors that are templates give
/// them to code that runs on `Memory`, which is HostMemory unless it is said, or WorkerMemory. The first call for a
/// memory that an array isn't in copies it there; any thread may make it, and throws OutOfMemory where there is no
/// room.
class GALE_EXPORT Mesh {
 public:
  /// Encodes in the workers' space, in parallel, in time O(n); on the host if it doesn't fit the device's memory, and
  /// says so in notice(). Peak memory beside the input: 20 bytes a cell and 4 an external one, and 16 a vertex.
  ///
  /// `Index` is std::int32_t or std::int64_t. Throws gale::Error, naming the cell at fault, where there is none (unless
  /// the mesh is a part), where one has a vertex outside 0..vertices-1 or the same twice, and where two have the same
  /// vertices.
  ///
  /// With an `exchange` the mesh is one rank's part of a larger one.
  template <class Index, class Memory>
  Mesh(const Tetrahedra<Index, Memory>& tetrahedra, const Segmentation& segmentation,
       std::shared_ptr<const Exchange> exchange = nullptr);

  /// Encodes triangles likewise.
  template <class Index, class Memory>
  Mesh(const Triangles<Index, Memory>& triangles, const Segmentation& segmentation,
       std::shared_ptr<const Exchange> exchange = nullptr);

  /// A grid, with `capacity` vertices a segment, consecutive ones. Nothing is encoded: what kernels read is computed,
  /// and its ids are those of the input. Whatever else asks for arrays (encoded(), simplices(), permutations) has them
  /// made then, where the mesh is. Throws gale::Error for a capacity below 1, and where there is no cell.
  explicit Mesh(const Grid& grid, int capacity = default_capacity);

  /// One rank's part of a grid: the vertices `owned`, which have segments of their own, and ghosts before and after.
  Mesh(const Grid& grid, int capacity, const Interval& owned, std::shared_ptr<const Exchange> exchange);

  /// The grid that it is; null if it is none.
  const Grid* grid() const;

  /// Is it the same mesh, or a copy of it? Another one of equal tetrahedra isn't.
  bool operator==(const Mesh& other) const { return data_ == other.data_; }

  int dimension() const;  ///< that of its cells: 3 where these are tetrahedra, 2 where they are triangles
  Id vertices() const;    ///< how many vertices it has, ghosts included
  Id cells() const;       ///< how many tetrahedra it has, or triangles if its dimension is 2
  Id segments() const;    ///< how many segments it has, those of ghosts included

  /// Sweeps go through these segments: all of them, unless this is one rank's part of a mesh. Then the others hold
  /// ghosts: vertices that other ranks own, which are there for cells that touch owned ones. Rows of ghosts lack what
  /// the rank doesn't have.
  Interval owned_segments() const;
  Interval owned_vertices() const;  ///< what these segments hold

  /// What this part of a mesh asks of other ranks; a whole mesh asks nobody.
  const Exchange& exchange() const;

  /// Whether it is one rank's part of a mesh, which may be all of it where there is one rank.
  bool is_part() const;

  /// The global id of a vertex, by its input id: that itself unless the mesh is a part.
  GlobalId vertex_id(Id vertex) const { return exchange().vertex_id(vertex); }

  /// The global id of a cell, by its input id: that itself unless the mesh is a part.
  GlobalId cell_id(Id cell) const { return exchange().cell_id(cell); }

  /// The input id of the vertex that has a global id; no_id if the mesh doesn't hold it.
  Id vertex_of(GlobalId id) const;

  GlobalId all_vertices() const;  ///< how many vertices the parts of all ranks have together
  GlobalId all_cells() const;     ///< how many cells the parts of all ranks have together

  /// Whether its arrays lie in a device's memory. Tables of simplices that are made later may lie in the host's.
  bool on_device() const;

  /// One line on what didn't fit the device's memory, so that the host computes; empty if everything did, so far.
  std::string notice() const;

  /// The arrays that relations are computed from. Valid as long as the mesh or a copy of it.
  template <class Memory = HostMemory>
  const EncodedMesh<Memory>& encoded() const;

  /// All simplices; at least what `needs` says. What is missing is enumerated by the first call that needs it (see
  /// SimplexNeeds), where the mesh is, or on the host if it doesn't fit the device's memory. Edges take 8 bytes each
  /// and 4 a vertex, triangles 4 each and 4 an edge, triangle_edge 4 a triangle, lower edges 4 an edge and a vertex.
  /// Time O(n); O(n log n) for the triangles of vertices that have more than 32 higher neighbours. Throws gale::Error
  /// if there are more than 2^31 - 1 edges or triangles.
  template <class Memory = HostMemory>
  Simplices<Memory> simplices(const SimplexNeeds& needs) const;

  /// How many edges there are; no_id as long as nobody needed them.
  Id known_edges() const;

  /// How many triangles there are; no_id as long as nobody needed them.
  Id known_triangles() const;

  /// The intervals: where the simplices of a dimension, 0 to that of the mesh, that are internal to each segment begin,
  /// and one past the last (I_V, I_E, I_F and I_T). Edges, and triangles that aren't the cells, are enumerated if they
  /// haven't been. The host always has those that are there: no lock.
  template <class Memory = HostMemory>
  const Array<const Id, Memory>& interval_begin(int dimension) const;

  /// The simplices that are internal to a segment.
  Intervals intervals_of(Id segment) const;

  /// Where each segment's vertices begin, and one past the last: interval_begin(0), on the host.
  const Array<const Id, HostMemory>& vertex_begin() const;

  /// Where each segment's row of T_ex begins, on the host.
  const Array<const Offset, HostMemory>& external_begin() const;

  /// GALE's vertex -> input vertex.
  template <class Memory = HostMemory>
  const Array<const Id, Memory>& vertex_input() const;

  /// Input vertex -> GALE's vertex.
  template <class Memory = HostMemory>
  const Array<const Id, Memory>& vertex_internal() const;

  /// GALE's cell -> input cell.
  template <class Memory = HostMemory>
  const Array<const Id, Memory>& cell_input() const;

  /// What vertex_input() says, without a table where that says nothing: of a grid.
  template <class Memory = HostMemory>
  OtherIds vertices_in_input() const;

  /// What vertex_internal() says, likewise.
  template <class Memory = HostMemory>
  OtherIds vertices_of_input() const;

  /// What cell_input() says, likewise.
  template <class Memory = HostMemory>
  OtherIds cells_in_input() const;

  /// Input ids of some vertices, read where all are known: none of the others' are copied.
  std::vector<Id> input_of_vertices(const std::vector<Id>& vertices) const;

  /// Input ids of some cells, likewise.
  std::vector<Id> input_of_cells(const std::vector<Id>& cells) const;

  /// The vertices of cells. Valid as long as the mesh or a copy of it.
  template <class Memory = HostMemory>
  CellReader cell_reader() const;

  /// The segment that a simplex of a dimension up to the mesh's (GALE's id) is internal to: a binary search among the
  /// segments.
  Id segment_of(int dimension, Id simplex) const;

  /// What someone found out about the mesh, and keeps with it and its copies: what `make` returned when this was first
  /// called with that key. Any thread may call; those that come at once wait. If `make` throws, the next one tries.
  std::shared_ptr<const void> kept(const std::string& key,
                                   const std::function<std::shared_ptr<const void>()>& make) const;

 private:
  class Data;
  std::shared_ptr<const Data> data_;
};

/// Computes something from a mesh in the workers' space if the mesh is there, and on the host's threads otherwise, or
/// if it doesn't fit the device's memory: f(WorkerSpace()) or f(HostExecutionSpace()).
template <class F>
auto in_worker_or_host_space(const Mesh& mesh, const F& f) {
  return in_worker_or_host_space(mesh.on_device(), f);
}

}  // namespace gale
