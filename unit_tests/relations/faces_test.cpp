#include <gtest/gtest.h>

#include <gale/base/parallel.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

#include "relations/every_relation_mesh.hpp"
#include "support/arrays.hpp"

namespace gale::test {

namespace {

using Table = ExpectedRows::Table;

template <Relation relation>
Table on_the_host(const Mesh& mesh, std::size_t rows) {
  const auto simplices = mesh.simplices(needs_of(relation));
  Table table;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto row = face_row<relation>(simplices, static_cast<Id>(i));
    table.emplace_back(row.begin(), row.end());
  }
  return table;
}

template <Relation relation>
Table in_a_kernel(const Mesh& mesh, std::size_t rows) {
  constexpr int size = face_count(relation);
  const auto simplices = mesh.simplices<WorkerMemory>(needs_of(relation));
  const auto ids = allocate<Array<Id, WorkerMemory>>("ids", rows * size);
  parallel_for(
      "test_face_rows", WorkerSpace(), rows, KOKKOS_LAMBDA(Offset i) {
        const auto row = face_row<relation>(simplices, static_cast<Id>(i));
        for (int entry = 0; entry < face_count(relation); ++entry) ids(face_count(relation) * i + entry) = row[entry];
      });
  const auto all = to_vector(ids);
  Table table;
  for (std::size_t i = 0; i < rows; ++i) table.emplace_back(all.begin() + size * i, all.begin() + size * (i + 1));
  return table;
}

template <Relation relation>
void expect_look_ups(const Mesh& for_host, const Mesh& for_kernel, const ExpectedRows& expected) {
  const Table& rows = expected[relation];
  EXPECT_EQ(on_the_host<relation>(for_host, rows.size()), rows) << name_of(relation);
  EXPECT_EQ(in_a_kernel<relation>(for_kernel, rows.size()), rows) << name_of(relation) << " in a kernel";
}

}  // namespace

class FaceRowsOf : public EveryRelationMesh {
 protected:
  FaceRowsOf() : EveryRelationMesh(face_relations) {}
};

TEST_P(FaceRowsOf, every_mesh_are_those_of_brute_force_on_the_host_and_in_kernels) {
  expect_look_ups<Relation::EV>(fresh_mesh(), fresh_mesh(), expected);
  expect_look_ups<Relation::FV>(fresh_mesh(), fresh_mesh(), expected);
  expect_look_ups<Relation::FE>(fresh_mesh(), fresh_mesh(), expected);
  expect_look_ups<Relation::TV>(fresh_mesh(), fresh_mesh(), expected);
  expect_look_ups<Relation::TE>(fresh_mesh(), fresh_mesh(), expected);
  expect_look_ups<Relation::TF>(fresh_mesh(), fresh_mesh(), expected);
}

INSTANTIATE_TEST_SUITE_P(Tests, FaceRowsOf, every_relation_mesh_and_segmentation(), mesh_and_segmentation);

TEST(FaceRows, have_as_many_entries_as_a_simplex_has_such_faces) {
  EXPECT_EQ(face_count(Relation::EV), 2);
  EXPECT_EQ(face_count(Relation::FV), 3);
  EXPECT_EQ(face_count(Relation::FE), 3);
  EXPECT_EQ(face_count(Relation::TV), 4);
  EXPECT_EQ(face_count(Relation::TE), 6);
  EXPECT_EQ(face_count(Relation::TF), 4);
}

/// Edges 01 02 03 12 13 23, triangles 012 013 023 123.
TEST(FaceRows, of_one_tetrahedron) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 0, 0}));
  EXPECT_EQ(on_the_host<Relation::EV>(mesh, 6), (Table{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(on_the_host<Relation::FV>(mesh, 4), (Table{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(on_the_host<Relation::FE>(mesh, 4), (Table{{0, 1, 3}, {0, 2, 4}, {1, 2, 5}, {3, 4, 5}}));
  EXPECT_EQ(on_the_host<Relation::TE>(mesh, 1), (Table{{0, 1, 2, 3, 4, 5}}));
  EXPECT_EQ(on_the_host<Relation::TF>(mesh, 1), (Table{{0, 1, 2, 3}}));
}

}  // namespace gale::test
