#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gale/outputs/named_simplices.hpp>

#include "outputs/outputs_of.hpp"
#include "support/voxel_shapes.hpp"

namespace gale::test {

namespace {

template <class Face, class Simplex>
bool is_face(const Face& face, const Simplex& of) {
  return std::all_of(face.begin(), face.end(), [&](Id v) { return std::find(of.begin(), of.end(), v) != of.end(); });
}

/// A random field on a ball, whose complex has paths of each kind.
OutputsOf some_complex() {
  const InputMesh mesh = ball(6);
  std::vector<double> field(mesh.points.size());
  std::iota(field.begin(), field.end(), 0);
  std::shuffle(field.begin(), field.end(), std::mt19937(3));
  return outputs_of(mesh, field);
}

/// Is the simplex before each cell of each path a face of it, and of the cell before it on the path?
template <class Cell, class Simplex, class VerticesOf>
void expect_between(const Separatrices<Cell>& paths, const outputs::SharedPaths& shared, const Simplex* between,
                    const std::vector<Simplex>& saddles, const VerticesOf& vertices_of) {
  ASSERT_GT(paths.count(), 0);
  for (Id i = 0; i < paths.count(); ++i) {
    EXPECT_EQ(between[shared.between(paths.begin[i])], saddles[paths.sources[i]]);
    for (Offset k = paths.begin[i]; k < paths.begin[i + 1]; ++k) {
      const Simplex& before = between[shared.between(k)];
      EXPECT_TRUE(is_face(before, vertices_of(paths.cells[k])));
      if (k > paths.begin[i]) EXPECT_TRUE(is_face(before, vertices_of(paths.cells[k - 1])));
    }
  }
}

/// Has each cell, and each simplex between cells, one number, in the order in which paths come to them?
template <class Cell, class Simplex>
void expect_shared(const Separatrices<Cell>& paths, const outputs::SharedPaths& shared, const Simplex* between) {
  std::map<Cell, Id> cells;
  std::map<Simplex, Id> simplices;
  for (std::size_t k = 0; k < paths.cells.size(); ++k) {
    EXPECT_EQ(cells.emplace(paths.cells[k], static_cast<Id>(cells.size())).first->second, shared.cell(k));
    Simplex sorted = between[shared.between(k)];
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(simplices.emplace(sorted, static_cast<Id>(simplices.size())).first->second, shared.between(k));
    EXPECT_EQ(paths.cells[shared.first_cell(shared.cell(k))], paths.cells[k]);
    EXPECT_LE(shared.first_between(shared.between(k)), static_cast<Id>(k));
  }
  EXPECT_EQ(shared.first_cell.extent(0), cells.size());
  EXPECT_EQ(shared.first_between.extent(0), simplices.size());
  EXPECT_LT(cells.size(), paths.cells.size()) << "nothing is in common";
}

}  // namespace

TEST(NamedSimplices, precede_the_cells_of_paths) {
  const OutputsOf of = some_complex();
  const MorseSmaleComplex& complex = of.complex;
  const outputs::detail::NamedGroups groups(complex, of.named);
  const auto& tetrahedra = complex.gradient.mesh().encoded().cells;
  const auto corners = [&](Id t) {
    return std::array<Id, 4>{tetrahedra(t, 0), tetrahedra(t, 1), tetrahedra(t, 2), tetrahedra(t, 3)};
  };
  expect_between(complex.connectors, of.named.connectors, of.named.edges.data() + groups.connector_edges,
                 complex.critical.edges, [](const TriangleVertices& triangle) { return triangle; });
  expect_between(complex.ascending, of.named.ascending, of.named.triangles.data() + groups.ascending_triangles,
                 complex.critical.triangles, corners);
}

TEST(NamedSimplices, of_a_falling_path_join_its_vertices) {
  const OutputsOf of = some_complex();
  const Separatrices<Id>& paths = of.complex.descending;
  const auto* const edges = of.named.edges.data() + outputs::detail::NamedGroups(of.complex, of.named).descending_edges;
  ASSERT_GT(paths.count(), 0);
  for (Id i = 0; i < paths.count(); ++i) {
    for (Offset k = paths.begin[i] + 1; k < paths.begin[i + 1]; ++k)
      EXPECT_EQ(edges[of.named.descending.between(k)], (std::array<Id, 2>{paths.cells[k - 1], paths.cells[k]}));
  }
}

TEST(NamedSimplices, are_there_once_for_all_paths_of_a_kind) {
  const OutputsOf of = some_complex();
  const outputs::detail::NamedGroups groups(of.complex, of.named);
  expect_shared(of.complex.descending, of.named.descending, of.named.edges.data() + groups.descending_edges);
  expect_shared(of.complex.ascending, of.named.ascending, of.named.triangles.data() + groups.ascending_triangles);
  expect_shared(of.complex.connectors, of.named.connectors, of.named.edges.data() + groups.connector_edges);
}

TEST(NamedSimplices, begin_with_the_critical_ones_and_end_with_those_on_connectors) {
  const OutputsOf of = some_complex();
  const MorseSmaleComplex& complex = of.complex;
  const auto& edges = of.named.edges;
  const auto& triangles = of.named.triangles;
  EXPECT_TRUE(std::equal(complex.critical.edges.begin(), complex.critical.edges.end(), edges.begin()));
  EXPECT_TRUE(std::equal(complex.critical.triangles.begin(), complex.critical.triangles.end(), triangles.begin()));
  const outputs::detail::NamedGroups groups(complex, of.named);
  const auto& connected = complex.connectors.cells;
  for (std::size_t k = 0; k < connected.size(); ++k)
    EXPECT_EQ(triangles[groups.connector_triangles + of.named.connectors.cell(k)], connected[k]);
  EXPECT_EQ(triangles.size(), groups.connector_triangles + of.named.connectors.first_cell.extent(0));
}

}  // namespace gale::test
