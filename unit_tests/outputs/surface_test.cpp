#include <gale/outputs/arrows.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/persistence.hpp>

#include "outputs/outputs_of.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

namespace {

using Bytes = std::vector<std::int8_t>;
using Ids = std::vector<Id>;
using Values = std::vector<double>;

/// Two tents: vertex 0 (value 10) over 2 3 4 5, vertex 1 (value 9) over 3 2 6 7. Minima are 4 and 6, critical edges 23
/// between the tents, 25 and 37 on the rim, and maxima triangles 0 (023) and 4 (132). Edges are numbered 02 03 04 05,
/// 12 13 16 17, 23 25 26, 34 37, 45, 67 from 0.
struct TwoTents {
  TwoTents() {
    surface.points = {{0, 0, 0}, {3, 4, 0}, {3, 0, 0}, {0, 4, 0}, {-3, 0, 0}, {0, -3, 0}, {6, 4, 0}, {3, 7, 0}};
    surface.triangles = {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {1, 3, 2}, {1, 2, 6}, {1, 6, 7}, {1, 7, 3}};
    const io::Dataset::Points<double> points("points", surface.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) points(v, axis) = surface.points[v][axis];
    }
    dataset.points = points;
    dataset.arrays = {field};
  }

  DiscreteGradient gradient() const {
    const auto& values = std::get<Values>(field.values);
    return find_discrete_gradient(VertexOrder(encode(surface, 3), values.data(), values.size()));
  }

  InputSurface surface;
  io::PointArray field{"field", 1, Values{10, 9, 5, 6, 1, 2, 0, 3}};
  io::Dataset dataset;
};

outputs::MorseSmaleOutputs outputs_of_tents() {
  const TwoTents tents;
  return outputs::morse_smale(tents.gradient(), tents.dataset, tents.field, {});
}

}  // namespace

TEST(SurfaceOutputs, have_critical_vertices_edges_and_triangles) {
  const auto points = outputs_of_tents().critical_points;
  EXPECT_EQ(values_of<std::int8_t>(points.arrays, "CellDimension"), (Bytes{0, 0, 1, 1, 1, 2, 2}));
  EXPECT_EQ(values_of<Id>(points.arrays, "CellId"), (Ids{4, 6, 8, 9, 12, 0, 4}));
  EXPECT_EQ(values_of<Id>(points.arrays, "ttkVertexScalarField"), (Ids{4, 6, 3, 2, 3, 0, 1}));
  EXPECT_EQ(values_of<double>(points.arrays, "field"), (Values{1, 0, 6, 5, 6, 10, 9}));
  EXPECT_EQ(values_of<Id>(points.arrays, "ManifoldSize"), (Ids{4, 4, 0, 0, 0, 5, 3}));
  EXPECT_EQ(values_of<std::int8_t>(points.arrays, "IsOnBoundary"), (Bytes{1, 1, 1, 1, 1, 0, 0}));
  // Triangles at their incentres: these have sides of 3, 4 and 5.
  expect_points(points.points,
                {{-3, 0, 0}, {6, 4, 0}, {1.5, 2, 0}, {1.5, -1.5, 0}, {1.5, 5.5, 0}, {1, 1, 0}, {2, 3, 0}});
}

TEST(SurfaceOutputs, have_separatrices_over_vertices_and_over_triangles) {
  const auto lines = outputs_of_tents().separatrices1;
  const auto along = [&](const auto& values) {
    std::vector<Id> all;
    for (const std::int32_t point : lines.lines.points) all.push_back(values[point]);
    return all;
  };
  EXPECT_EQ(along(values_of<std::int8_t>(lines.point_arrays, "CellDimension")),
            (Ids{1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0,  // falling
                 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2}));
  EXPECT_EQ(along(values_of<Id>(lines.point_arrays, "CellId")),
            (Ids{8, 2, 10, 6, 8, 3, 11, 4, 9,  2, 10, 6, 9, 5, 13, 4, 12, 3, 11, 4, 12, 7, 14, 6,  // falling
                 8, 0, 8,  4, 9, 3, 0,  0, 12, 7, 5,  4}));
  EXPECT_EQ(lines.lines.begin, (std::vector<std::int64_t>{0, 4, 8, 12, 16, 20, 24, 26, 28, 32, 36}));
  EXPECT_EQ(values_of<std::int8_t>(lines.cell_arrays, "SeparatrixType"), (Bytes{0, 0, 0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "DestinationId"), (Ids{6, 4, 6, 4, 4, 6, 0, 4, 0, 4}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "SourceId"), (Ids{8, 8, 9, 9, 12, 12, 8, 8, 9, 12}));
  const auto highest = values_of<double>(lines.cell_arrays, "SeparatrixFunctionMaximum");
  EXPECT_EQ(Values(highest.begin() + 6, highest.end()), (Values{10, 9, 10, 9}));
}

TEST(SurfaceOutputs, have_manifolds) {
  const auto arrays = outputs_of_tents().manifolds;
  EXPECT_EQ(values_of<Id>(arrays, "DescendingManifold"), (Ids{0, 1, 1, 0, 0, 0, 1, 1}));
  EXPECT_EQ(values_of<Id>(arrays, "AscendingManifold"), (Ids{0, 1, 0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(values_of<Id>(arrays, "MorseSmaleManifold"), (Ids{0, 2, 1, 0, 0, 0, 2, 2}));
}

/// The pair of minimum 4 and edge 25; minimum 6, which never ends; the pairs of edges 23 and 37 with the maxima.
TEST(SurfaceOutputs, have_a_diagram_of_two_types_of_pairs) {
  const TwoTents tents;
  const DiscreteGradient gradient = tents.gradient();
  const auto diagram = outputs::persistence_diagram(gradient, find_persistence_pairs(gradient), tents.field);
  const io::Surface lines = outputs::to_lines(tents.dataset, tents.field, diagram);
  EXPECT_EQ(values_of<Id>(lines.point_arrays, "ttkVertexScalarField"), (Ids{4, 2, 6, 0, 3, 1, 3, 0}));
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "CriticalType"), (Bytes{0, 1, 0, 3, 2, 3, 2, 3}));
  EXPECT_EQ(values_of<std::int8_t>(lines.cell_arrays, "PairType"), (Bytes{0, 0, 1, 1, -1}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "Birth"), (Values{1, 0, 6, 6, 0}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "Persistence"), (Values{4, 10, 3, 4, 8}));
  EXPECT_EQ(values_of<std::uint8_t>(lines.cell_arrays, "IsFinite"), (std::vector<std::uint8_t>{1, 0, 1, 1, 0}));
}

/// Without the minimum 4 and the lower maximum.
TEST(SurfaceOutputs, are_simplified) {
  const TwoTents tents;
  outputs::MorseSmaleRequest request;
  request.persistence = outputs::Persistence{4, false};
  const auto all = outputs::morse_smale(tents.gradient(), tents.dataset, tents.field, request);
  EXPECT_EQ(values_of<Id>(all.critical_points.arrays, "CellId"), (Ids{4, 6, 9, 12, 0}));
  EXPECT_EQ(values_of<Id>(all.manifolds, "AscendingManifold"), Ids(8, 0));
  request.persistence = outputs::Persistence{4.5, false};
  const auto less = outputs::morse_smale(tents.gradient(), tents.dataset, tents.field, request);
  EXPECT_EQ(values_of<Id>(less.critical_points.arrays, "CellId"), (Ids{6}));
  EXPECT_EQ(values_of<Id>(less.manifolds, "DescendingManifold"), Ids(8, 0));
}

/// Vertices 0 1 2 3 5 7 to their lowest edges; then edges of triangles, by their higher and their lower vertices.
TEST(SurfaceOutputs, have_arrows_of_vertices_and_edges) {
  const TwoTents tents;
  const io::PointSet arrows = outputs::arrows_of(tents.dataset, tents.gradient());
  EXPECT_EQ(values_of<std::int8_t>(arrows.arrays, "CellDimension"), (Bytes{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  // Edges 02 03 05 go to 025, 034, 045; edges 12 13 17 to 126, 137, 167.
  expect_points(arrows.points, {{0, 0, 0},
                                {3, 4, 0},
                                {3, 0, 0},
                                {0, 4, 0},
                                {0, -3, 0},
                                {3, 7, 0},
                                {1.5, 0, 0},
                                {0, 2, 0},
                                {0, -1.5, 0},
                                {3, 2, 0},
                                {1.5, 4, 0},
                                {3, 5.5, 0}});
  const auto vectors = values_of<double>(arrows.arrays, "Vector");
  ASSERT_EQ(vectors.size(), 36u);
  const Values of_edges(vectors.begin() + 18, vectors.begin() + 27);
  const Values expected = {-0.5, -1, 0, -1, -2.0 / 3, 0, -1, 0.5, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(of_edges[i], expected[i], 1e-12) << i;
}

}  // namespace gale::test
