#include <algorithm>
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
void expect_between(const Separatrices<Cell>& paths, const Simplex* between, const std::vector<Simplex>& saddles,
                    const VerticesOf& vertices_of) {
  ASSERT_GT(paths.count(), 0);
  for (Id i = 0; i < paths.count(); ++i) {
    EXPECT_EQ(between[paths.begin[i]], saddles[paths.sources[i]]);
    for (Offset k = paths.begin[i]; k < paths.begin[i + 1]; ++k) {
      EXPECT_TRUE(is_face(between[k], vertices_of(paths.cells[k])));
      if (k > paths.begin[i]) EXPECT_TRUE(is_face(between[k], vertices_of(paths.cells[k - 1])));
    }
  }
}

}  // namespace

TEST(NamedSimplices, precede_the_cells_of_paths) {
  const OutputsOf of = some_complex();
  const MorseSmaleComplex& complex = of.complex;
  const outputs::detail::NamedGroups groups(complex);
  const auto& tetrahedra = complex.gradient.mesh().encoded().cells;
  const auto corners = [&](Id t) {
    return std::array<Id, 4>{tetrahedra(t, 0), tetrahedra(t, 1), tetrahedra(t, 2), tetrahedra(t, 3)};
  };
  expect_between(complex.connectors, of.named.edges.data() + groups.connector_edges, complex.critical.edges,
                 [](const TriangleVertices& triangle) { return triangle; });
  expect_between(complex.ascending, of.named.triangles.data() + groups.ascending_triangles, complex.critical.triangles,
                 corners);
}

TEST(NamedSimplices, of_a_falling_path_join_its_vertices) {
  const OutputsOf of = some_complex();
  const Separatrices<Id>& paths = of.complex.descending;
  const auto* const edges = of.named.edges.data() + outputs::detail::NamedGroups(of.complex).descending_edges;
  ASSERT_GT(paths.count(), 0);
  for (Id i = 0; i < paths.count(); ++i) {
    EXPECT_EQ(edges[paths.begin[i]], of.complex.critical.edges[paths.sources[i]]);
    for (Offset k = paths.begin[i] + 1; k < paths.begin[i + 1]; ++k)
      EXPECT_EQ(edges[k], (std::array<Id, 2>{paths.cells[k - 1], paths.cells[k]}));
  }
}

TEST(NamedSimplices, begin_with_the_critical_ones_and_end_with_those_on_connectors) {
  const OutputsOf of = some_complex();
  const MorseSmaleComplex& complex = of.complex;
  const auto& edges = of.named.edges;
  const auto& connected = complex.connectors.cells;
  const auto& triangles = of.named.triangles;
  EXPECT_TRUE(std::equal(complex.critical.edges.begin(), complex.critical.edges.end(), edges.begin()));
  EXPECT_TRUE(std::equal(complex.critical.triangles.begin(), complex.critical.triangles.end(), triangles.begin()));
  EXPECT_TRUE(std::equal(connected.rbegin(), connected.rend(), triangles.rbegin()));
  EXPECT_EQ(edges.size(), complex.critical.edges.size() + complex.descending.cells.size() + connected.size());
  EXPECT_EQ(triangles.size(), complex.critical.triangles.size() + complex.ascending.cells.size() + connected.size());
}

}  // namespace gale::test
