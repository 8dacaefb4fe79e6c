#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gale/ttk/triangulation.hpp>

#include "expected_triangulation.hpp"

namespace gale::test {

/// The names of all meshes and surfaces that tests loop over, and one of them.
inline std::vector<std::string> all_names() {
  auto names = mesh_names();
  for (const auto& [name, surface] : surfaces()) names.push_back(name);
  return names;
}
inline AnyMesh any_mesh(const std::string& name) {
  return surfaces().count(name) != 0 ? AnyMesh(surfaces().at(name)) : AnyMesh(mesh_named(name));
}

/// A name for a test.
inline std::string name_for_test(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// A mesh as TTK's callers have it, which a triangulation refers to.
struct CallersMesh {
  std::vector<double> points;
  std::vector<::ttk::LongSimplexId> cells;  ///< 4 v0 v1 v2 v3 each, or 3 v0 v1 v2

  explicit CallersMesh(const AnyMesh& mesh) {
    for (const auto& point : mesh.points) points.insert(points.end(), point.begin(), point.end());
    for (const auto& cell : mesh.cells) {
      cells.push_back(static_cast<Id>(cell.size()));
      cells.insert(cells.end(), cell.begin(), cell.end());
    }
  }

  Id vertices() const { return static_cast<Id>(points.size() / 3); }
  Id count() const { return static_cast<Id>(cells.size() / (cells[0] + 1)); }

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
  if (mesh.getDimensionality() == 3) mesh.preconditionTriangleLinks();
  if (mesh.getDimensionality() == 3) mesh.preconditionTriangleStars();
  mesh.preconditionVertexEdges();
  mesh.preconditionVertexLinks();
  mesh.preconditionVertexNeighbors();
  mesh.preconditionVertexStars();
  mesh.preconditionVertexTriangles();
  mesh.preconditionManifold();
}

}  // namespace gale::test
