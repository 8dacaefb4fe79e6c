#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/algorithms/surface_vertices.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

std::vector<Id> to_vector(const Array<const Id, HostMemory>& numbers) {
  return {numbers.data(), numbers.data() + numbers.extent(0)};
}

/// All edges and triangles of a mesh, in the order of GALE's ids, the vertices of each in any.
NamedSimplices all_simplices(const Mesh& mesh) {
  SimplexNeeds needs;
  needs.upto = Enumeration::triangles;
  const auto all = mesh.simplices(needs);
  std::mt19937 random(7);
  NamedSimplices named;
  for (Id e = 0; e < mesh.known_edges(); ++e) {
    named.edges.push_back({all.edge_low(e), all.edge_high(e)});
    std::shuffle(named.edges.back().begin(), named.edges.back().end(), random);
  }
  for (Id f = 0; f < mesh.known_triangles(); ++f) {
    const Id edge = all.triangle_edge(f);
    named.triangles.push_back({all.edge_low(edge), all.edge_high(edge), all.triangle_apex(f)});
    std::shuffle(named.triangles.back().begin(), named.triangles.back().end(), random);
  }
  return named;
}

}  // namespace

class SimplexNumbersOf : public EveryMesh {};

TEST_P(SimplexNumbersOf, every_mesh_are_those_of_the_enumeration_on_every_structure) {
  const Mesh enumerated = encode(input(), segmentation());
  const NamedSimplices named = all_simplices(enumerated);
  const auto in_64_bits = [](const std::vector<Id>& ids) { return std::vector<GlobalId>(ids.begin(), ids.end()); };
  const auto edges = in_64_bits(to_vector(input_numbers(enumerated, 1))),
             triangles = in_64_bits(to_vector(input_numbers(enumerated, 2)));
  const auto on_surface = surface_vertices(enumerated);
  for (const auto& kind : structure_kinds()) {
    SCOPED_TRACE(kind.name);
    const Mesh mesh = encode(input(), segmentation());
    const auto structure = kind.make(mesh, simplex_numbers_relations);
    const SimplexNumbers numbers = number_simplices(*structure, named, with_threads(2));
    EXPECT_EQ(numbers.edges, edges);
    EXPECT_EQ(numbers.triangles, triangles);
    for (Id v = 0; v < mesh.vertices(); ++v) EXPECT_EQ(numbers.on_surface(v), on_surface(v)) << v;
    EXPECT_EQ(mesh.known_edges(), no_id) << "nothing is enumerated";
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplexNumbersOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

/// GALE's vertices of two tetrahedra 4 1 3 2 and 0 3 1 2, by input id.
class SimplexNumbersOfTwo : public testing::Test {
 protected:
  const Mesh mesh = encode(mesh_named("two_sharing_a_triangle"), octree_of(mesh_named("two_sharing_a_triangle"), 2));
  std::unique_ptr<Structure> runtime = make_structure(mesh, simplex_numbers_relations);

  Id vertex(Id input) const { return mesh.vertex_internal()(input); }
  std::array<Id, 2> edge(Id a, Id b) const { return {vertex(a), vertex(b)}; }
  std::array<Id, 3> triangle(Id a, Id b, Id c) const { return {vertex(a), vertex(b), vertex(c)}; }
};

TEST_F(SimplexNumbersOfTwo, are_places_in_lexicographic_order) {
  // 01 02 03 12 13 14 23 24 34, and 012 013 023 123 124 134 234
  const auto numbers =
      number_simplices(*runtime, {{edge(3, 2), edge(0, 1), edge(4, 1), edge(3, 4), edge(0, 1)},
                                  {triangle(3, 2, 1), triangle(0, 1, 2), triangle(4, 2, 3), triangle(3, 1, 2)}});
  EXPECT_EQ(numbers.edges, (std::vector<GlobalId>{6, 0, 5, 8, 0}));
  EXPECT_EQ(numbers.triangles, (std::vector<GlobalId>{3, 0, 6, 3}));
}

TEST_F(SimplexNumbersOfTwo, of_nothing_are_none) {
  const auto numbers = number_simplices(*runtime, {});
  EXPECT_TRUE(numbers.edges.empty());
  EXPECT_TRUE(numbers.triangles.empty());
  EXPECT_EQ(numbers.on_surface.extent(0), 5u);
}

TEST_F(SimplexNumbersOfTwo, of_what_is_not_there_are_refused) {
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{edge(4, 0)}, {}});
            }),
            "no simplex of the mesh has just the input vertices 0 4");
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{edge(2, 2)}, {}});
            }),
            "no simplex of the mesh has just the input vertices 2 2");
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{}, {triangle(4, 0, 1)}});
            }),
            "no simplex of the mesh has just the input vertices 0 1 4");
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{}, {triangle(3, 1, 3)}});
            }),
            "no simplex of the mesh has just the input vertices 1 3 3");
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{{0, 5}}, {}});
            }),
            "no vertex 5 to number a simplex of: there are 5");
  EXPECT_EQ(message_of([&] {
              number_simplices(*runtime, {{}, {{0, -1, 2}}});
            }),
            "no vertex -1 to number a simplex of: there are 5");
}

TEST(SimplexNumbers, of_a_vertex_with_more_neighbours_than_bits) {
  for (const Id degree : {64, 65, 300}) {
    const InputMesh input = cone_over_disc(degree);  // vertex 0 is in all triangles but those of the disc
    const Mesh mesh = encode(input, 100);
    const auto runtime = make_structure(mesh, simplex_numbers_relations);
    const auto internal = mesh.vertex_internal();
    const auto numbers = number_simplices(*runtime, {{{internal(degree), internal(0)}, {internal(2), internal(1)}},
                                                     {{internal(degree), internal(0), internal(1)}}});
    EXPECT_EQ(numbers.edges, (std::vector<GlobalId>{degree - 1, degree}));  // the last of 0's, and the next
    EXPECT_EQ(numbers.triangles, (std::vector<GlobalId>{degree - 2}));      // the last of 0 and 1, of degree - 1
  }
}

TEST(SimplexNumbers, need_the_relations_that_they_read) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const auto runtime = make_structure(mesh, Relation::VV);
  EXPECT_THROW(number_simplices(*runtime, {}), Error);
}

}  // namespace gale::test
