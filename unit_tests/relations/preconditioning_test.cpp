#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/relations/preconditioning.hpp>

#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

void expect_needs(RelationSet relations, Enumeration upto, bool lower_edges, bool tetrahedra) {
  const SimplexNeeds needs = needs_of(relations);
  EXPECT_EQ(needs.upto, upto) << name_of(relations);
  EXPECT_EQ(needs.lower_edges, lower_edges) << name_of(relations);
  EXPECT_EQ(needs.cells, tetrahedra) << name_of(relations);
}

}  // namespace

TEST(Preconditioning, finds_edges_of_triangles_for_rows_of_triangles_alone) {
  for (const Relation relation : members_of(all_relations)) {
    const bool of_triangles = row_dimension(relation) == 2;
    EXPECT_EQ(needs_of(relation).triangle_edge, of_triangles) << name_of(relation);
    EXPECT_EQ(needs_of(relation | Relation::EV).triangle_edge, of_triangles) << name_of(relation);
  }
}

TEST(Preconditioning, of_stars_needs_nothing_enumerated) {
  expect_needs(star_relations, Enumeration::cells, false, false);
}

TEST(Preconditioning, of_face_relations_needs_the_simplices_that_they_are_about) {
  expect_needs(Relation::EV, Enumeration::edges, false, false);
  expect_needs(Relation::FV, Enumeration::triangles, false, false);
  expect_needs(Relation::FE, Enumeration::triangles, false, false);
  expect_needs(Relation::TV, Enumeration::cells, false, true);
  expect_needs(Relation::TE, Enumeration::edges, false, true);
  expect_needs(Relation::TF, Enumeration::triangles, false, true);
}

TEST(Preconditioning, of_coboundary_and_adjacency_needs_edges_by_their_higher_vertex) {
  expect_needs(Relation::VE, Enumeration::edges, true, false);
  expect_needs(Relation::VF, Enumeration::triangles, true, false);
  expect_needs(Relation::EF, Enumeration::triangles, true, false);
  expect_needs(Relation::ET, Enumeration::edges, true, true);
  expect_needs(Relation::FT, Enumeration::triangles, true, true);
  expect_needs(Relation::EE, Enumeration::edges, true, false);
  expect_needs(Relation::FF, Enumeration::triangles, true, false);
  expect_needs(Relation::TT, Enumeration::edges, true, true);
}

TEST(Preconditioning, of_several_needs_what_any_of_them_needs) {
  expect_needs(RelationSet(), Enumeration::cells, false, false);
  expect_needs(Relation::VV | Relation::TV, Enumeration::cells, false, true);
  expect_needs(Relation::FV | Relation::VE, Enumeration::triangles, true, false);
  expect_needs((all_relations | link_form), Enumeration::triangles, true, true);
}

TEST(Preconditioning, names_what_was_forgotten_and_what_to_do) {
  EXPECT_NO_THROW(require_preconditioned(Relation::VV | Relation::EF, Relation::EF));
  EXPECT_NO_THROW(require_preconditioned(Relation::VV, RelationSet()));
  const std::string what_to_do = ": name every relation that you read when you construct it";
  EXPECT_EQ(message_of([] { require_preconditioned(Relation::VV | Relation::EF, Relation::EF | Relation::TT); }),
            "the structure was preconditioned for EF, VV, not for TT" + what_to_do);
  EXPECT_EQ(message_of([] { require_preconditioned(RelationSet(), link_form); }),
            "the structure was preconditioned for no relation, not for link" + what_to_do);
}

/// One tetrahedron: 4 vertices, 6 edges, 4 triangles.
TEST(Preconditioning, names_a_simplex_that_is_not_there_by_dimension_number_and_range) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 1, 1}));
  const Id counts[] = {4, 6, 4, 1};
  for (int dimension = 0; dimension < 4; ++dimension) {
    EXPECT_NO_THROW(require_simplex(mesh, dimension, 0));
    EXPECT_NO_THROW(require_simplex(mesh, dimension, counts[dimension] - 1));
  }
  EXPECT_EQ(message_of([&] { require_simplex(mesh, 0, 4); }), "there is no vertex 4: the mesh has 0 to 3");
  EXPECT_EQ(message_of([&] { require_simplex(mesh, 1, 6); }), "there is no edge 6: the mesh has 0 to 5");
  EXPECT_EQ(message_of([&] { require_simplex(mesh, 2, -1); }), "there is no triangle -1: the mesh has 0 to 3");
  EXPECT_EQ(message_of([&] { require_simplex(mesh, 3, 1); }), "there is no tetrahedron 1: the mesh has 0 to 0");
}

TEST(Kernels, are_one_for_the_star_and_one_for_each_other_relation) {
  EXPECT_TRUE(kernels_for(RelationSet()).empty());
  EXPECT_EQ(kernels_for(Relation::VV | link_form), (std::vector<RelationSet>{Relation::VV | link_form}));
  EXPECT_EQ(kernels_for(Relation::VT | Relation::EF | Relation::TV | link_form),
            (std::vector<RelationSet>{Relation::TV, Relation::EF, Relation::VT | link_form}));
  EXPECT_EQ(kernels_for((all_relations | link_form)).size(), 15u);
}

}  // namespace gale::test
