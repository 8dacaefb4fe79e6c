#include <atomic>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "expected_triangulation.hpp"
#include "fixtures.hpp"
#include "support/message_of.hpp"
#include "support/voxel_shapes.hpp"

namespace gale::test {

namespace {

using Mesh = ::ttk::AbstractTriangulation;
using Table = ExpectedTriangulation::Table;

/// A kind of rows: its queries, and what they must give.
struct Rows {
  const char* name;
  ::ttk::SimplexId (Mesh::*size)(const ::ttk::SimplexId&) const;
  int (Mesh::*entry)(const ::ttk::SimplexId&, const int&, ::ttk::SimplexId&) const;
  const std::vector<std::vector<::ttk::SimplexId>>* (Mesh::*all)();
  Table ExpectedTriangulation::*expected;
};

#define ROWS(One, Many, expected) \
  { #Many, &Mesh::get##One##Number, &Mesh::get##One, &Mesh::get##Many, &ExpectedTriangulation::expected }
const Rows kinds[] = {ROWS(VertexNeighbor, VertexNeighbors, vertex_neighbours),
                      ROWS(VertexEdge, VertexEdges, vertex_edges),
                      ROWS(VertexTriangle, VertexTriangles, vertex_triangles),
                      ROWS(VertexStar, VertexStars, vertex_stars),
                      ROWS(VertexLink, VertexLinks, vertex_links),
                      ROWS(EdgeTriangle, EdgeTriangles, edge_triangles),
                      ROWS(EdgeStar, EdgeStars, edge_stars),
                      ROWS(EdgeLink, EdgeLinks, edge_links),
                      ROWS(TriangleEdge, TriangleEdges, triangle_edges),
                      ROWS(TriangleStar, TriangleStars, triangle_stars),
                      ROWS(TriangleLink, TriangleLinks, triangle_links),
                      ROWS(CellEdge, CellEdges, cell_edges),
                      ROWS(CellTriangle, CellTriangles, cell_triangles),
                      ROWS(CellNeighbor, CellNeighbors, cell_neighbours)};
#undef ROWS

/// The row of a simplex, entry by entry.
std::vector<Id> row_of(const Mesh& mesh, const Rows& kind, Id simplex) {
  std::vector<Id> row((mesh.*kind.size)(simplex));
  for (int i = 0; i < static_cast<int>(row.size()); ++i) (mesh.*kind.entry)(simplex, i, row[i]);
  return row;
}

void expect_rows(const Mesh& mesh, const ExpectedTriangulation& expected) {
  for (const Rows& kind : kinds) {
    const Table& rows = expected.*kind.expected;
    for (Id i = 0; i < static_cast<Id>(rows.size()); ++i) {
      ASSERT_EQ(row_of(mesh, kind, i), rows[i]) << kind.name << " of " << i;
    }
  }
}

void expect_simplices(const Mesh& mesh, const AnyMesh& input, const ExpectedTriangulation& expected) {
  EXPECT_EQ(mesh.getDimensionality(), input.dimension());
  EXPECT_EQ(mesh.isManifold(), expected.manifold);
  ASSERT_EQ(mesh.getNumberOfVertices(), input.vertices());
  ASSERT_EQ(mesh.getNumberOfEdges(), static_cast<Id>(expected.edges.size()));
  ASSERT_EQ(mesh.getNumberOfTriangles(), static_cast<Id>(expected.triangles.size()));
  ASSERT_EQ(mesh.getNumberOfCells(), static_cast<Id>(input.cells.size()));
  Id vertex = no_id;
  for (Id v = 0; v < input.vertices(); ++v) {
    ASSERT_EQ(mesh.isVertexOnBoundary(v), expected.vertex_on_surface[v]) << v;
    float point[3];
    mesh.getVertexPoint(v, point[0], point[1], point[2]);
    for (const int axis : {0, 1, 2}) ASSERT_EQ(point[axis], static_cast<float>(input.points[v][axis])) << v;
  }
  for (Id e = 0; e < mesh.getNumberOfEdges(); ++e) {
    ASSERT_EQ(mesh.isEdgeOnBoundary(e), expected.edge_on_surface[e]) << e;
    for (const int i : {1, 0}) {
      mesh.getEdgeVertex(e, i, vertex);
      ASSERT_EQ(vertex, expected.edges[e][i]) << e;
    }
  }
  for (Id f = 0; f < mesh.getNumberOfTriangles(); ++f) {
    ASSERT_EQ(mesh.isTriangleOnBoundary(f), expected.triangle_on_surface[f]) << f;
    for (const int i : {2, 0, 1}) {
      mesh.getTriangleVertex(f, i, vertex);
      ASSERT_EQ(vertex, expected.triangles[f][i]) << f;
    }
  }
  for (Id c = 0; c < mesh.getNumberOfCells(); ++c) {
    ASSERT_EQ(mesh.getCellVertexNumber(c), input.dimension() + 1);
    for (int i = 0; i <= input.dimension(); ++i) {
      mesh.getCellVertex(c, i, vertex);
      ASSERT_EQ(vertex, input.cells[c][i]) << c;
    }
  }
}

class TtkTriangulation : public testing::TestWithParam<std::string> {
 protected:
  AnyMesh input() const { return any_mesh(GetParam()); }
};

TEST_P(TtkTriangulation, answers_as_an_explicit_one_in_segments_of_any_size) {
  const CallersMesh callers(input());
  const ExpectedTriangulation expected(input());
  for (const int capacity : {1, 13, 100000}) {
    SCOPED_TRACE(capacity);
    ttk::Options options;
    options.capacity = capacity;
    ttk::Triangulation mesh(options);
    callers.set(mesh);
    precondition_all(mesh);
    EXPECT_TRUE(mesh.printed.empty());
    expect_simplices(mesh, input(), expected);
    expect_rows(mesh, expected);
  }
}

TEST_P(TtkTriangulation, gives_lists_of_all) {
  const CallersMesh callers(input());
  const ExpectedTriangulation expected(input());
  ttk::Triangulation mesh;
  callers.set(mesh);
  precondition_all(mesh);
  for (const Rows& kind : kinds) {
    if ((expected.*kind.expected).empty()) continue;  // stars and links of triangles that are cells
    EXPECT_EQ(*(mesh.*kind.all)(), expected.*kind.expected) << kind.name;
  }
  const auto& edges = *mesh.getEdges();
  ASSERT_EQ(edges.size(), expected.edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    EXPECT_TRUE(std::equal(edges[e].begin(), edges[e].end(), expected.edges[e].begin()));
  }
  const auto& triangles = *mesh.getTriangles();
  ASSERT_EQ(triangles.size(), expected.triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    EXPECT_TRUE(std::equal(triangles[f].begin(), triangles[f].end(), expected.triangles[f].begin()));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, TtkTriangulation, testing::ValuesIn(all_names()), name_for_test);

/// Threads that ask for everything in an order of their own, all rows of a mesh several times.
void read_on_threads(const Mesh& mesh, const ExpectedTriangulation& expected, int threads, int reads) {
  std::atomic<int> wrong{0};
  std::vector<std::thread> readers;
  for (int thread = 0; thread < threads; ++thread) {
    readers.emplace_back([&, thread] {
      std::mt19937 random(thread);
      for (int i = 0; i < reads; ++i) {
        const Rows& kind = kinds[random() % std::size(kinds)];
        const Table& rows = expected.*kind.expected;
        if (rows.empty()) continue;
        const Id simplex = static_cast<Id>(random() % rows.size());
        if (row_of(mesh, kind, simplex) != rows[simplex]) ++wrong;
      }
    });
  }
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(wrong, 0);
}

TEST(TtkTriangulationOnThreads, answers_in_every_way_of_computing_with_and_without_memory) {
  const InputMesh solid = voxels(6, 5, 4, [](Id x, Id y, Id z) { return (x + 2 * y + 3 * z) % 5 != 0; });
  for (const AnyMesh& input : {AnyMesh(solid), AnyMesh(torus(12, 11))}) {
    const CallersMesh callers(input);
    const ExpectedTriangulation expected(input);
    for (const Way way : {Way::gale, Way::leaders, Way::inline_}) {
      for (const std::size_t memory : {std::size_t(1), std::size_t(20000), std::size_t(0)}) {
        SCOPED_TRACE(std::string(name_of(way)) + ", " + std::to_string(memory));
        ttk::Options options;
        options.capacity = 12;
        options.memory = memory;
        options.structure.way = way;
        ttk::Triangulation mesh(options);
        callers.set(mesh);
        precondition_all(mesh);
        read_on_threads(mesh, expected, 4, 1500);
      }
    }
  }
}

TEST(TtkTriangulationOnThreads, keeps_several_apart_and_outlives_threads) {
  const InputMesh inputs[2] = {ball(6), mesh_named("several_components")};
  const CallersMesh callers[2] = {CallersMesh(inputs[0]), CallersMesh(inputs[1])};
  const ExpectedTriangulation expected[2] = {ExpectedTriangulation(inputs[0]), ExpectedTriangulation(inputs[1])};
  for (int round = 0; round < 3; ++round) {  // others may get the addresses of those that are gone
    ttk::Triangulation meshes[2];
    for (const int i : {0, 1}) {
      callers[(i + round) % 2].set(meshes[i]);
      meshes[i].preconditionVertexNeighbors();
      meshes[i].preconditionEdgeStars();
    }
    for (int thread = 0; thread < 4; ++thread) {  // one after the other: ids of threads come again
      std::thread([&] {
        for (Id simplex = 0; simplex < 17; ++simplex) {
          for (const int i : {0, 1}) {
            const auto& right = expected[(i + round) % 2];
            EXPECT_EQ(row_of(meshes[i], kinds[0], simplex), right.vertex_neighbours[simplex]);
            EXPECT_EQ(row_of(meshes[i], kinds[6], simplex), right.edge_stars[simplex]);
          }
        }
      }).join();
    }
  }
}

TEST(TtkTriangulationSteps, may_be_preconditioned_in_any_order_and_again_after_reading) {
  const InputMesh input = ball(6);
  const CallersMesh callers(input);
  const ExpectedTriangulation expected(input);
  ttk::Triangulation mesh;
  callers.set(mesh);
  mesh.preconditionTriangleEdges();
  mesh.preconditionVertexNeighbors();
  EXPECT_EQ(row_of(mesh, kinds[0], 5), expected.vertex_neighbours[5]);
  mesh.preconditionVertexStars();
  mesh.preconditionBoundaryVertices();  // after neighbours: in their sweep
  EXPECT_EQ(row_of(mesh, kinds[0], 5), expected.vertex_neighbours[5]);
  EXPECT_EQ(row_of(mesh, kinds[3], 7), expected.vertex_stars[7]);
  precondition_all(mesh);
  expect_simplices(mesh, input, expected);
  expect_rows(mesh, expected);
  const std::size_t before = mesh.footprint();
  EXPECT_GT(before, 0u);
  EXPECT_EQ(mesh.footprint(5), before + 5);
}

TEST(TtkTriangulationSteps, finds_vertices_on_the_boundary_with_and_without_rows_and_facets) {
  for (const char* const name : {"holed_grid_9", "plane"}) {
    const AnyMesh input = any_mesh(name);
    const CallersMesh callers(input);
    const ExpectedTriangulation expected(input);
    using Steps = std::vector<int (Mesh::*)()>;
    const auto surface = &Mesh::preconditionBoundaryVertices, rows = &Mesh::preconditionVertexNeighbors,
               facets = &Mesh::preconditionManifold;
    for (const Steps& steps : {Steps{surface}, Steps{surface, rows}, Steps{rows, surface}, Steps{surface, facets},
                               Steps{facets, surface}, Steps{surface, rows, facets}}) {
      ttk::Triangulation mesh;
      callers.set(mesh);
      for (const auto step : steps) (mesh.*step)();
      std::vector<std::thread> readers;
      std::atomic<int> wrong{0};
      for (int thread = 0; thread < 3; ++thread) {
        readers.emplace_back([&] {
          for (Id v = 0; v < input.vertices(); ++v)
            wrong += mesh.isVertexOnBoundary(v) != expected.vertex_on_surface[v];
        });
      }
      for (std::thread& reader : readers) reader.join();
      EXPECT_EQ(wrong, 0) << steps.size();
    }
  }
}

TEST(TtkTriangulationSteps, begins_anew_with_other_cells) {
  const AnyMesh inputs[3] = {ball(6), mesh_named("isolated_vertices"), torus(7, 5)};
  const CallersMesh callers[3] = {CallersMesh(inputs[0]), CallersMesh(inputs[1]), CallersMesh(inputs[2])};
  ttk::Triangulation mesh;
  for (const int i : {0, 1, 2, 0}) {
    callers[i].set(mesh);
    precondition_all(mesh);
    const ExpectedTriangulation expected(inputs[i]);
    expect_simplices(mesh, inputs[i], expected);
    expect_rows(mesh, expected);
  }
  mesh.clear();
  EXPECT_TRUE(mesh.isEmpty());
  EXPECT_EQ(mesh.getNumberOfCells(), 0);
  EXPECT_EQ(mesh.footprint(3), 3u);
}

/// What setting these cells prints.
std::vector<std::string> printed(const std::vector<::ttk::LongSimplexId>& cells, Id count) {
  const std::vector<double> points(15, 0.5);
  ttk::Triangulation mesh;
  EXPECT_EQ(mesh.setInputPoints(5, points.data(), true), 0);
  EXPECT_EQ(mesh.setInputCells(count, cells.data()), -1);
  EXPECT_LT(mesh.preconditionVertexNeighbors(), 0);
  mesh.printed.pop_back();  // that nothing is preconditioned
  return mesh.printed;
}

TEST(TtkTriangulationErrors, are_printed_with_the_value_at_fault) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(printed({4, 0, 1, 2, 3, 4, 1, 2, 7, 3}, 2), Lines{"cell 1 has the vertex 7, but there are 5 points"});
  EXPECT_EQ(printed({4, 0, 1, 2, -9}, 1), Lines{"cell 0 has the vertex -9, but there are 5 points"});
  EXPECT_EQ(printed({4, 0, 1, 2, 3, 3, 1, 2, 3}, 2),
            Lines{"cell 1 has 3 vertices: GALE takes tetrahedra alone, or triangles alone"});
  EXPECT_EQ(printed({3, 0, 1, 2, 3, 1, 2, 7}, 2), Lines{"cell 1 has the vertex 7, but there are 5 points"});
  EXPECT_EQ(printed({2, 0, 1}, 1), Lines{"cell 0 has 2 vertices: GALE takes tetrahedra alone, or triangles alone"});
  EXPECT_EQ(printed({4, 0, 1, 2, 3}, -1), Lines{"-1 cells: there may be 0 to 2147483647"});
  EXPECT_EQ(printed({4, 0, 1, 1, 3}, 1), Lines{"cell 0 has the vertex 1 twice"});
}

TEST(TtkTriangulationErrors, rows_that_nobody_preconditioned_are_refused_by_name) {
  const CallersMesh callers(ball(6));
  ttk::Triangulation mesh;
  EXPECT_LT(mesh.preconditionEdges(), 0);
  EXPECT_EQ(mesh.printed, std::vector<std::string>{"there are no points and cells yet: nothing is preconditioned"});
  callers.set(mesh);
  EXPECT_EQ(mesh.getNumberOfEdges(), 0);
  mesh.preconditionVertexNeighbors();
  EXPECT_EQ(message_of([&] { mesh.getVertexStarNumber(0); }), "rows of VT were not preconditioned");
  EXPECT_EQ(message_of([&] { mesh.getEdgeStarNumber(0); }), "rows of ET were not preconditioned");
  EXPECT_EQ(message_of([&] { mesh.getTriangleStarNumber(0); }), "rows of FT were not preconditioned");
  EXPECT_EQ(message_of([&] { mesh.isVertexOnBoundary(0); }), "what is on the boundary was not preconditioned");
  EXPECT_EQ(message_of([&] { mesh.isEdgeOnBoundary(0); }), "what is on the boundary was not preconditioned");
}

TEST(TtkTriangulationErrors, stars_of_triangles_that_are_cells_are_refused) {
  const CallersMesh callers(torus(7, 5));
  ttk::Triangulation mesh;
  callers.set(mesh);
  EXPECT_LT(mesh.preconditionTriangleStars(), 0);
  EXPECT_EQ(mesh.printed,
            std::vector<std::string>{
                "a mesh of triangles has no relation FT: it has those among vertices, edges and triangles"});
  EXPECT_EQ(message_of([&] { mesh.getTriangleStarNumber(0); }), "rows of FT were not preconditioned");
  EXPECT_EQ(message_of([&] { mesh.getVertexStarNumber(0); }), "rows of VF were not preconditioned");
}

}  // namespace

}  // namespace gale::test
