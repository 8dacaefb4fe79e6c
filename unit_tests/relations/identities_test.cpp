#include <algorithm>

#include <gtest/gtest.h>

#include <gale/runtime/batches/host_worker.hpp>

#include "support/brute_force.hpp"
#include "support/segmentations.hpp"
#include "support/voxel_shapes.hpp"

// What holds on any mesh, on meshes larger than brute force is for.

namespace gale::test {

namespace {

using Table = ExpectedRows::Table;

/// The rows of all simplices, by segments.
Table rows_of(const Mesh& mesh, Relation relation) {
  Table table;
  HostWorker worker(mesh, relation);
  for (Id s = 0; s < mesh.segments(); ++s) {
    const SegmentRows rows = worker.compute(s);
    const int dimension = row_dimension(relation);
    EXPECT_EQ(static_cast<std::size_t>(rows.interval(dimension).first), table.size());
    for (const Id i : rows.interval(dimension)) {
      const Row row = rows[relation][i];
      table.emplace_back(row.begin(), row.end());
    }
  }
  return table;
}

/// Ascending rows, as the rows themselves must be.
Table transposed(const Table& table, std::size_t columns) {
  Table result(columns);
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (const Id j : table[i]) result.at(j).push_back(static_cast<Id>(i));
  }
  return result;
}

void expect_identities(const Mesh& mesh) {
  constexpr Relation pairs[][2] = {{Relation::EV, Relation::VE}, {Relation::FV, Relation::VF},
                                   {Relation::FE, Relation::EF}, {Relation::TV, Relation::VT},
                                   {Relation::TE, Relation::ET}, {Relation::TF, Relation::FT}};
  for (const auto& [faces, coboundary] : pairs) {
    const Table xy = rows_of(mesh, faces), yx = rows_of(mesh, coboundary);
    EXPECT_EQ(transposed(xy, yx.size()), yx) << name_of(coboundary) << " is not the transpose of " << name_of(faces);
  }
  for (const Relation adjacency : members_of(adjacency_relations)) {
    const Table table = rows_of(mesh, adjacency);
    EXPECT_EQ(transposed(table, table.size()), table) << name_of(adjacency) << " is not symmetric, or not ascending";
    for (std::size_t i = 0; i < table.size(); ++i) {
      ASSERT_FALSE(std::binary_search(table[i].begin(), table[i].end(), static_cast<Id>(i)))
          << name_of(adjacency) << " of " << i << " has it";
    }
  }
}

/// Vertices less edges plus triangles less tetrahedra.
Id euler_characteristic(const Mesh& mesh) {
  mesh.interval_begin(2);
  return mesh.vertices() - mesh.known_edges() + mesh.known_triangles() - mesh.cells();
}

Mesh segmented(const InputMesh& input) { return encode(input, 100); }

}  // namespace

TEST(Identities, hold_on_a_grid_with_holes) { expect_identities(segmented(holed_grid(15))); }

TEST(Identities, hold_around_a_cavity) { expect_identities(segmented(thick_shell(9))); }

TEST(EulersFormula, gives_1_for_a_ball_0_for_a_solid_torus_and_2_for_a_thick_shell) {
  for (const Id side : {3, 12}) {
    EXPECT_EQ(euler_characteristic(segmented(ball(side))), 1);
    EXPECT_EQ(euler_characteristic(segmented(solid_torus(side))), 0);
    EXPECT_EQ(euler_characteristic(segmented(thick_shell(side))), 2);
  }
}

/// Cones are contractible, and so is a tetrahedron; each component counts.
TEST(EulersFormula, gives_the_number_of_contractible_components) {
  EXPECT_EQ(euler_characteristic(segmented(cone_over_disc(500))), 1);
  EXPECT_EQ(euler_characteristic(segmented(cone_over_caps(500, 3))), 1);
  EXPECT_EQ(euler_characteristic(segmented(mesh_named("two_sharing_a_vertex"))), 1);
  EXPECT_EQ(euler_characteristic(segmented(mesh_named("several_components"))), 5) << "three, and two isolated vertices";
}

#ifdef GALE_ENABLE_VTK

TEST(Identities, hold_on_a_delaunay_tetrahedralization) {
  const Mesh mesh = segmented(delaunay_mesh(2000));
  expect_identities(mesh);
  EXPECT_EQ(euler_characteristic(mesh), 1) << "the convex hull of points is a ball";
}

#endif

}  // namespace gale::test
