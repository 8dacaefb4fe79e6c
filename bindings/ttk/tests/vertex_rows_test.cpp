#include <atomic>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "expected_triangulation.hpp"
#include "fixtures.hpp"
#include "support/voxel_shapes.hpp"

// Neighbours, stars and boundary of vertices, where nothing else is needed: then nothing is encoded, unless a structure
// is to make the rows.

namespace gale::test {

namespace {

void precondition_vertices(::ttk::AbstractTriangulation& mesh) {
  mesh.preconditionVertexNeighbors();
  mesh.preconditionVertexStars();
  mesh.preconditionBoundaryVertices();
}

/// How many vertices have other rows, or another flag. `begin`, `step`: in which order one asks.
int wrong_vertices(const ttk::Triangulation& mesh, const ExpectedTriangulation& expected, Id begin, Id step) {
  const Id vertices = mesh.getNumberOfVertices();
  int wrong = 0;
  std::vector<Id> row;
  for (Id i = 0; i < vertices; ++i) {
    const Id v = static_cast<Id>((begin + Offset(i) * step) % vertices);
    row.resize(mesh.getVertexNeighborNumber(v));
    for (int k = 0; k < static_cast<int>(row.size()); ++k) mesh.getVertexNeighbor(v, k, row[k]);
    const bool same = row == expected.vertex_neighbours[v];
    row.resize(mesh.getVertexStarNumber(v));
    for (int k = 0; k < static_cast<int>(row.size()); ++k) mesh.getVertexStar(v, k, row[k]);
    const bool all = same && row == expected.vertex_stars[v] &&
                     mesh.isVertexOnBoundary(v) == static_cast<bool>(expected.vertex_on_surface[v]);
    if (!all) ++wrong;
  }
  return wrong;
}

class TtkVertexRows : public testing::TestWithParam<std::string> {};

TEST_P(TtkVertexRows, are_those_of_an_explicit_one_in_segments_of_any_size) {
  const AnyMesh input = any_mesh(GetParam());
  const CallersMesh callers(input);
  const ExpectedTriangulation expected(input);
  for (const Way way : {Way::gale, Way::inline_}) {
    for (const int capacity : {1, 13, 100000}) {
      for (const std::size_t memory : {0, 1, 4000}) {
        SCOPED_TRACE(std::string(name_of(way)) + ", " + std::to_string(capacity) + ", " + std::to_string(memory));
        ttk::Options options;
        options.capacity = capacity;
        options.memory = memory;
        options.structure.way = way;
        ttk::Triangulation mesh(options);
        callers.set(mesh);
        precondition_vertices(mesh);
        EXPECT_TRUE(mesh.printed.empty());
        EXPECT_EQ(wrong_vertices(mesh, expected, 0, 1), 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, TtkVertexRows, testing::ValuesIn(all_names()), name_for_test);

TEST(TtkTriangulationOnThreads, reads_rows_of_vertices_with_and_without_a_sweep) {
  const InputMesh input = ball(9);
  const CallersMesh callers(input);
  const ExpectedTriangulation expected(input);
  for (const bool sweep : {true, false}) {
    for (const std::size_t memory : {0, 1, 6000}) {
      SCOPED_TRACE(std::to_string(sweep) + ", " + std::to_string(memory));
      ttk::Options options;
      options.capacity = 8;
      options.memory = memory;
      ttk::Triangulation mesh(options);
      callers.set(mesh);
      if (sweep) {
        precondition_vertices(mesh);
      } else {
        mesh.preconditionBoundaryVertices();  // before neighbours it waits until somebody reads it
        mesh.preconditionVertexStars();
        mesh.preconditionVertexNeighbors();
      }
      std::atomic<int> wrong{0};
      std::vector<std::thread> readers;
      for (const Id step : {1, 1, 1, 7}) {
        const Id begin = static_cast<Id>(readers.size()) * callers.vertices() / 4;
        readers.emplace_back([&, step, begin] { wrong += wrong_vertices(mesh, expected, begin, step); });
      }
      for (std::thread& reader : readers) reader.join();
      EXPECT_EQ(wrong, 0);
    }
  }
}

TEST(TtkVertexRowsThen, edges_may_be_needed_after_reading) {
  const InputMesh input = ball(6);
  const CallersMesh callers(input);
  const ExpectedTriangulation expected(input);
  ttk::Triangulation mesh;
  callers.set(mesh);
  precondition_vertices(mesh);
  EXPECT_EQ(wrong_vertices(mesh, expected, 0, 1), 0);
  const std::size_t before = mesh.footprint();
  mesh.preconditionEdges();
  EXPECT_EQ(mesh.getNumberOfEdges(), static_cast<Id>(expected.edges.size()));
  EXPECT_EQ(wrong_vertices(mesh, expected, 0, 1), 0);
  EXPECT_NE(mesh.footprint(), before);
}

/// TTK's explicit triangulation takes a cell twice, and so do the rows of vertices without a device; all else refuses
/// it.
TEST(TtkVertexRowsThen, a_cell_may_be_there_twice_until_more_is_needed) {
  InputMesh input = mesh_named("several_components");
  input.tetrahedra.push_back(input.tetrahedra[1]);
  std::swap(input.tetrahedra.back()[0], input.tetrahedra.back()[2]);
  const CallersMesh callers(input);
  const ExpectedTriangulation expected(input);
  ttk::Triangulation mesh;
  callers.set(mesh);
  if (!have_device) {
    precondition_vertices(mesh);
    EXPECT_TRUE(mesh.printed.empty());
    EXPECT_EQ(wrong_vertices(mesh, expected, 0, 1), 0);
    mesh.preconditionEdges();
  }
  ASSERT_EQ(mesh.printed.size(), 1u);
  EXPECT_EQ(mesh.printed[0],
            "tetrahedra 1 and " + std::to_string(callers.count() - 1) + " have the same four vertices");
  if (!have_device) EXPECT_EQ(wrong_vertices(mesh, expected, 0, 1), 0);  // what was found stays
}

}  // namespace

}  // namespace gale::test
