#pragma once

#include <vector>

#include <gale/ttk/triangulation.hpp>

#include "support/input_mesh.hpp"

namespace gale::test {

/// A mesh as TTK's callers have it, which a triangulation refers to.
struct CallersMesh {
  std::vector<double> points;
  std::vector<::ttk::LongSimplexId> cells;  ///< 4 v0 v1 v2 v3 each

  explicit CallersMesh(const InputMesh& mesh) {
    for (const auto& point : mesh.points) points.insert(points.end(), point.begin(), point.end());
    for (const auto& cell : mesh.tetrahedra) {
      cells.push_back(4);
      cells.insert(cells.end(), cell.begin(), cell.end());
    }
  }

  Id vertices() const { return static_cast<Id>(points.size() / 3); }
  Id count() const { return static_cast<Id>(cells.size() / 5); }

  void set(ttk::Triangulation& triangulation) const {
    triangulation.setInputPoints(vertices(), points.data(), true);
    triangulation.setInputCells(count(), cells.data());
  }
};

/// All that TTK's modules can say that they will ask for.
inline void precondition_all(::ttk::AbstractTriangulation& mesh) {
  mesh.preconditionBoundaryEdges();
  mesh.preconditionBoundaryTriangles();
  mesh.preconditionBoundaryVertices();
  mesh.preconditionCellEdges();
  mesh.preconditionCellNeighbors();
  mesh.preconditionCellTriangles();
  mesh.preconditionEdges();
  mesh.preconditionEdgeLinks();
  mesh.preconditionEdgeStars();
  mesh.preconditionEdgeTriangles();
  mesh.preconditionTriangles();
  mesh.preconditionTriangleEdges();
  mesh.preconditionTriangleLinks();
  mesh.preconditionTriangleStars();
  mesh.preconditionVertexEdges();
  mesh.preconditionVertexLinks();
  mesh.preconditionVertexNeighbors();
  mesh.preconditionVertexStars();
  mesh.preconditionVertexTriangles();
  mesh.preconditionManifold();
}

}  // namespace gale::test
