#pragma once

#include <AbstractTriangulation.h>

#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/ttk/connectivity.hpp>
#include <gale/ttk/lists.hpp>

namespace gale::ttk {

/// One of TTK's triangulations, of tetrahedra or of triangles, that computes rows by segments as they are asked for.
/// Any of TTK's base modules takes it as its template argument, and gives the same results as on
/// ttk::ExplicitTriangulation, which has the same ids, and the same order of rows. As there: points and cells first,
/// then the module's preconditionTriangulation(), then the module.
///
/// Kokkos must be initialized, and stay so as long as this lives. The points and the cells must outlive it;
/// clear() forgets them. Setting and preconditioning are for one thread at a time, queries for any. Where GALE
/// throws, setting and preconditioning print the reason and return a value below 0; a query throws gale::Error, which
/// no OpenMP loop lets through, e.g. where the memory ends.
///
/// To be compiled with the TTK_ENABLE_... definitions of the TTK that it is used with.
class Triangulation final : public ::ttk::AbstractTriangulation {
 public:
  using SimplexId = ::ttk::SimplexId;

  explicit Triangulation(const Options& options = {}) : options_(options) {
    this->setDebugMsgPrefix("GALE");
    clear();
  }

  /// Forgets everything but the options.
  int clear() {
    connectivity_.reset();
    points_ = CallersPoints();
    cells_ = Cells();
    lists_ = Lists();
    this->isManifold_ = true;
    return ::ttk::AbstractTriangulation::clear();
  }

  int setInputPoints(const SimplexId& count, const void* points, const bool& doublePrecision = false) {
    if (connectivity_) clear();
    return attempt([&] {
      points_ = {points, id_of("points", count), doublePrecision};
      encode();
    });
  }

#ifdef TTK_CELL_ARRAY_NEW
  /// In TTK's layout of two arrays. All cells must be tetrahedra, or all triangles.
  int setInputCells(const SimplexId& count, const ::ttk::LongSimplexId* connectivity,
                    const ::ttk::LongSimplexId* offset) {
    return set_cells(count > 0 ? connectivity + offset[0] : connectivity, count, 0,
                     [&](Offset c) { return offset[c + 1] - offset[c]; });
  }
#else
  /// In TTK's flat layout. All cells must be tetrahedra, or all triangles.
  int setInputCells(const SimplexId& count, const ::ttk::LongSimplexId* cells) {
    const Offset stride = count > 0 && cells[0] == 3 ? 4 : 5;
    return set_cells(cells + 1, count, 1, [&](Offset c) { return cells[stride * c]; });
  }
#endif

  /// Bytes, added to `size`.
  std::size_t footprint(std::size_t size = 0) const { return connectivity_ ? size + connectivity_->bytes() : size; }

  // Queries. Each is what ttk::AbstractTriangulation says of the function of its name.

  int TTK_TRIANGULATION_INTERNAL(getDimensionality)() const override { return cells_.dimension(); }
  bool isEmpty() const override { return points_.count == 0; }
  SimplexId TTK_TRIANGULATION_INTERNAL(getNumberOfVertices)() const override { return points_.count; }
  SimplexId TTK_TRIANGULATION_INTERNAL(getNumberOfEdges)() const override { return count(1); }
  SimplexId TTK_TRIANGULATION_INTERNAL(getNumberOfTriangles)() const override { return count(2); }
  SimplexId TTK_TRIANGULATION_INTERNAL(getNumberOfCells)() const override { return cells_.count(); }

  int TTK_TRIANGULATION_INTERNAL(getVertexPoint)(const SimplexId& vertex, float& x, float& y, float& z) const override {
    const auto read = [&](const auto* of) {
      x = static_cast<float>(of[0]);
      y = static_cast<float>(of[1]);
      z = static_cast<float>(of[2]);
    };
    const Offset at = 3 * static_cast<Offset>(vertex);
    if (points_.in_double) {
      read(static_cast<const double*>(points_.coordinates) + at);
    } else {
      read(static_cast<const float*>(points_.coordinates) + at);
    }
    return 0;
  }

  bool TTK_TRIANGULATION_INTERNAL(isVertexOnBoundary)(const SimplexId& vertex) const override {
    return connectivity_->on_surface(0, vertex);
  }
  bool TTK_TRIANGULATION_INTERNAL(isEdgeOnBoundary)(const SimplexId& edge) const override {
    return connectivity_->on_surface(1, edge);
  }
  bool TTK_TRIANGULATION_INTERNAL(isTriangleOnBoundary)(const SimplexId& triangle) const override {
    return connectivity_->on_surface(2, triangle);
  }

  int TTK_TRIANGULATION_INTERNAL(getEdgeVertex)(const SimplexId& edge, const int& place,
                                                SimplexId& vertex) const override {
    vertex = connectivity_->edge(edge)[place];
    return 0;
  }
  int TTK_TRIANGULATION_INTERNAL(getTriangleVertex)(const SimplexId& triangle, const int& place,
                                                    SimplexId& vertex) const override {
    vertex = connectivity_->triangle(triangle)[place];
    return 0;
  }
  int TTK_TRIANGULATION_INTERNAL(getCellVertex)(const SimplexId& cell, const int& place,
                                                SimplexId& vertex) const override {
    vertex = cells_.vertex(cell, place);
    return 0;
  }
  SimplexId TTK_TRIANGULATION_INTERNAL(getCellVertexNumber)(const SimplexId&) const override {
    return cells_.corners();
  }

  const std::vector<std::array<SimplexId, 2>>* TTK_TRIANGULATION_INTERNAL(getEdges)() override {
    return detail::list(this->edgeList_, count(1), [&](Id i) { return connectivity_->edge(i); });
  }
  const std::vector<std::array<SimplexId, 3>>* TTK_TRIANGULATION_INTERNAL(getTriangles)() override {
    return detail::list(this->triangleList_, count(2), [&](Id i) { return connectivity_->triangle(i); });
  }

// The three functions of a kind of row: how many entries a simplex has, one of them, and the lists of all.
#define GALE_TTK_ROWS(One, Many, dimension, size, entry)                                                              \
  SimplexId TTK_TRIANGULATION_INTERNAL(get##One##Number)(const SimplexId& simplex) const override {                   \
    static_cast<void>(simplex);                                                                                       \
    return size;                                                                                                      \
  }                                                                                                                   \
  int TTK_TRIANGULATION_INTERNAL(get##One)(const SimplexId& simplex, const int& i, SimplexId& found) const override { \
    found = entry;                                                                                                    \
    return 0;                                                                                                         \
  }                                                                                                                   \
  const std::vector<std::vector<SimplexId>>* TTK_TRIANGULATION_INTERNAL(get##Many)() override {                       \
    return detail::list_rows(                                                                                         \
        lists_.Many, count(dimension), [this](Id simplex) { return size; },                                           \
        [this](Id simplex, int i) { return entry; });                                                                 \
  }

  GALE_TTK_ROWS(VertexNeighbor, VertexNeighbors, 0, connectivity_->row<Relation::VV>(simplex).size(),
                connectivity_->row<Relation::VV>(simplex)[i])
  GALE_TTK_ROWS(VertexEdge, VertexEdges, 0, connectivity_->row<Relation::VE>(simplex).size(),
                connectivity_->row<Relation::VE>(simplex)[i])
  GALE_TTK_ROWS(VertexTriangle, VertexTriangles, 0, connectivity_->row<Relation::VF>(simplex).size(),
                connectivity_->row<Relation::VF>(simplex)[i])
  GALE_TTK_ROWS(VertexStar, VertexStars, 0, connectivity_->row<Relation::VT>(simplex).size(),
                connectivity_->row<Relation::VT>(simplex)[i])
  GALE_TTK_ROWS(VertexLink, VertexLinks, 0, connectivity_->row<Relation::VT>(simplex).size(),
                connectivity_->link<Relation::VT>(simplex, std::array<Id, 1>{simplex}, i))
  GALE_TTK_ROWS(EdgeTriangle, EdgeTriangles, 1, connectivity_->row<Relation::EF>(simplex).size(),
                connectivity_->row<Relation::EF>(simplex)[i])
  GALE_TTK_ROWS(EdgeStar, EdgeStars, 1, connectivity_->row<Relation::ET>(simplex).size(),
                connectivity_->row<Relation::ET>(simplex)[i])
  GALE_TTK_ROWS(EdgeLink, EdgeLinks, 1, connectivity_->row<Relation::ET>(simplex).size(),
                connectivity_->link<Relation::ET>(simplex, connectivity_->edge(simplex), i))
  GALE_TTK_ROWS(TriangleEdge, TriangleEdges, 2, 3, connectivity_->triangle_edges(simplex)[i])
  GALE_TTK_ROWS(TriangleStar, TriangleStars, 2, connectivity_->row<Relation::FT>(simplex).size(),
                connectivity_->row<Relation::FT>(simplex)[i])
  GALE_TTK_ROWS(TriangleLink, TriangleLinks, 2, connectivity_->row<Relation::FT>(simplex).size(),
                connectivity_->link<Relation::FT>(simplex, connectivity_->triangle(simplex), i))
  GALE_TTK_ROWS(CellEdge, CellEdges, 3, cells_.edges(), connectivity_->cell_edges(simplex)[i])
  GALE_TTK_ROWS(CellTriangle, CellTriangles, 3,  // triangles that are cells have their neighbours there, as in TTK
                cells_.corners() == 4 ? 4 : connectivity_->cell_neighbours(simplex).size(),
                cells_.corners() == 4 ? connectivity_->cell_triangles(simplex)[i]
                                      : connectivity_->cell_neighbours(simplex)[i])
  GALE_TTK_ROWS(CellNeighbor, CellNeighbors, 3, connectivity_->cell_neighbours(simplex).size(),
                connectivity_->cell_neighbours(simplex)[i])
#undef GALE_TTK_ROWS

 protected:
  // What a module says that it will ask for.
  int preconditionBoundaryVerticesInternal() override { return need_surface(0); }
  int preconditionBoundaryEdgesInternal() override { return need_surface(1); }
  int preconditionBoundaryTrianglesInternal() override { return need_surface(2); }
  int preconditionVertexNeighborsInternal() override { return need_rows(Relation::VV); }
  int preconditionVertexEdgesInternal() override { return need_rows(Relation::VE); }
  int preconditionVertexTrianglesInternal() override { return need_rows(Relation::VF); }
  int preconditionVertexStarsInternal() override { return need_rows(Relation::VT); }
  int preconditionVertexLinksInternal() override { return need_rows(Relation::VT, cells_.dimension() - 1); }
  int preconditionEdgesInternal() override { return need(1); }
  int preconditionEdgeTrianglesInternal() override { return need_rows(Relation::EF); }
  int preconditionEdgeStarsInternal() override { return need_rows(Relation::ET); }
  int preconditionEdgeLinksInternal() override { return need_rows(Relation::ET); }
  int preconditionTrianglesInternal() override { return need(2); }
  int preconditionTriangleEdgesInternal() override { return need(1) != 0 ? -1 : need(2); }
  int preconditionTriangleStarsInternal() override { return need_rows(Relation::FT); }
  int preconditionTriangleLinksInternal() override { return need_rows(Relation::FT); }
  int preconditionCellEdgesInternal() override { return need(1); }
  int preconditionCellTrianglesInternal() override { return need(2); }
  int preconditionCellNeighborsInternal() override {
    return need_rows(cells_.dimension() == 2 ? Relation::ET : Relation::FT);
  }
  int preconditionManifoldInternal() override {
    if (need(cells_.dimension() - 1) != 0) return -1;
    this->isManifold_ = connectivity_->is_manifold();
    return 0;
  }

 private:
  /// What the functions return that list all rows: made when they are called.
  struct Lists {
    std::vector<std::vector<SimplexId>> VertexNeighbors, VertexEdges, VertexTriangles, VertexStars, VertexLinks,
        EdgeTriangles, EdgeStars, EdgeLinks, TriangleEdges, TriangleStars, TriangleLinks, CellEdges, CellTriangles,
        CellNeighbors;
  };

  template <class Action>
  int attempt(const Action& action) {
    try {
      const ThreadLimit limit(this->threadNumber_);
      action();
      return 0;
    } catch (const std::exception& error) {
      this->printErr(error.what());
      return -1;
    }
  }

  static Id id_of(const char* name, long long count) {
    if (count >= 0 && count <= std::numeric_limits<Id>::max()) return static_cast<Id>(count);
    throw Error(std::to_string(count) + " " + name + ": there may be 0 to 2147483647");
  }

  /// `between`: numbers between two cells' corners.
  template <class CornersOf>
  int set_cells(const ::ttk::LongSimplexId* first, const SimplexId& count, int between, const CornersOf& corners_of) {
    if (connectivity_) clear();
    return attempt([&] {
      const Id cells = id_of("cells", count);
      const int corners = count > 0 && corners_of(0) == 3 ? 3 : 4;
      for (Offset c = 0; c < cells; ++c) {
        if (corners_of(c) == corners) continue;
        throw Error("cell " + std::to_string(c) + " has " + std::to_string(corners_of(c)) +
                    " vertices: GALE takes tetrahedra alone, or triangles alone");
      }
      cells_ = Cells(first, corners, corners + between, cells);
      encode();
    });
  }

  /// As soon as there are both.
  void encode() {
    if (points_.count == 0 || cells_.count() == 0) return;
    connectivity_ = std::make_unique<Connectivity>(points_, cells_, options_);
  }

  template <class Need>
  int say(const Need& need) {
    return attempt([&] {
      if (!connectivity_) throw Error("there are no points and cells yet: nothing is preconditioned");
      need(*connectivity_);
    });
  }
  int need(int dimension) {
    return say([&](Connectivity& all) { all.need(dimension); });
  }
  int need_surface(int dimension) {
    return say([&](Connectivity& all) { all.need_surface(dimension); });
  }
  int need_rows(Relation relation, int also = 0) {
    if (also != 0 && need(also) != 0) return -1;
    return say([&](Connectivity& all) { all.need_rows(relation); });
  }

  /// 0 of what nobody preconditioned, as elsewhere in TTK.
  SimplexId count(int dimension) const {
    const Id found = connectivity_ ? connectivity_->count(dimension) : 0;
    return found == no_id ? 0 : found;
  }

  const Options options_;
  CallersPoints points_;
  Cells cells_;
  std::unique_ptr<Connectivity> connectivity_;
  Lists lists_;
};

}  // namespace gale::ttk
