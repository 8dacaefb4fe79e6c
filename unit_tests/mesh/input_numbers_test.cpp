#include <set>

#include <gtest/gtest.h>

#include <gale/mesh/input_numbers.hpp>
#include <gale/mesh/numbering/number.hpp>

#include "support/arrays.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Vertices = std::vector<Id>;

Vertices input_vertices(const Mesh& mesh, Vertices vertices) {
  for (Id& v : vertices) v = mesh.vertex_input()(v);
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Are the numbers the places of the simplices among all, by their input vertices?
void expect_places(const std::vector<Vertices>& simplices, const Array<const Id, HostMemory>& numbers) {
  const std::set<Vertices> sorted(simplices.begin(), simplices.end());
  const std::vector<Vertices> in_order(sorted.begin(), sorted.end());
  ASSERT_EQ(in_order.size(), simplices.size());
  ASSERT_EQ(numbers.extent(0), simplices.size());
  for (std::size_t i = 0; i < simplices.size(); ++i) ASSERT_EQ(in_order.at(numbers(i)), simplices[i]);
}

}  // namespace

class InputNumbersOf : public EveryMesh {};

TEST_P(InputNumbersOf, every_mesh_are_places_in_lexicographic_order) {
  const Mesh mesh = encode(input(), segmentation());
  SimplexNeeds needs;
  needs.upto = Enumeration::triangles;
  const auto all = mesh.simplices(needs);
  std::vector<Vertices> edges, triangles;
  for (Id e = 0; e < mesh.known_edges(); ++e)
    edges.push_back(input_vertices(mesh, {all.edge_low(e), all.edge_high(e)}));
  for (Id f = 0; f < mesh.known_triangles(); ++f) {
    const Id edge = all.triangle_edge(f);
    triangles.push_back(input_vertices(mesh, {all.edge_low(edge), all.edge_high(edge), all.triangle_apex(f)}));
  }
  expect_places(edges, input_numbers(mesh, 1));
  expect_places(triangles, input_numbers(mesh, 2));
  const InputNumbers both = input_numbers(mesh);
  EXPECT_EQ(to_vector(both.edges), to_vector(input_numbers(mesh, 1)));
  EXPECT_EQ(to_vector(both.triangles), to_vector(input_numbers(mesh, 2)));
}

TEST_P(InputNumbersOf, every_mesh_are_those_that_sorting_gives) {
  const Mesh mesh = encode(input(), segmentation());
  SimplexNeeds needs;
  needs.upto = Enumeration::triangles;
  const auto all = mesh.simplices(needs);
  const auto numbers = detail::number_by_vertex(all, mesh.vertex_input(), true, true);
  const auto sorted = detail::number_by_sorting(HostExecutionSpace(), all, mesh.vertex_input(), true, true);
  EXPECT_EQ(to_vector(numbers.edges.in<HostMemory>()), to_vector(sorted.edges.in<HostMemory>()));
  EXPECT_EQ(to_vector(numbers.triangles.in<HostMemory>()), to_vector(sorted.triangles.in<HostMemory>()));
}

INSTANTIATE_TEST_SUITE_P(Tests, InputNumbersOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(InputNumbers, of_vertices_and_tetrahedra_are_the_inputs) {
  const Mesh mesh = encode(mesh_named("the_papers"), 2);
  EXPECT_EQ(input_numbers(mesh, 0).data(), mesh.vertex_input().data());
  EXPECT_EQ(input_numbers(mesh, 3).data(), mesh.cell_input().data());
}

}  // namespace gale::test
