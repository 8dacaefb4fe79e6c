#include <gtest/gtest.h>

#include <gale/base/error.hpp>

#include "support/segmentations.hpp"

namespace gale::test {

namespace {

using Quads = std::vector<std::array<Id, 4>>;

std::string refusal_of(const InputMesh& mesh) {
  try {
    encode(mesh, segmentation_by(std::vector<std::int64_t>(mesh.points.size())));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal_of(std::size_t vertices, const Quads& tetrahedra) {
  return refusal_of(InputMesh{std::vector<std::array<double, 3>>(vertices), tetrahedra});
}

/// A valid mesh that is large enough for several threads to look at, with something put into it.
std::string refusal_with(std::size_t at, const std::array<Id, 4>& tetrahedron) {
  InputMesh mesh{std::vector<std::array<double, 3>>(20003), {}};
  for (Id i = 0; i < 20000; ++i) mesh.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
  mesh.tetrahedra.at(at) = tetrahedron;
  return refusal_of(mesh);
}

}  // namespace

TEST(MeshValidation, refuses_no_tetrahedra) {
  EXPECT_EQ(refusal_of(5, {}), "the mesh has no tetrahedra");
  EXPECT_EQ(refusal_of(0, {}), "the mesh has no tetrahedra");
}

TEST(MeshValidation, refuses_a_vertex_out_of_range) {
  EXPECT_EQ(refusal_of(4, {{0, 1, 2, 4}}), "tetrahedron 0 has vertex 4, but vertices are 0 to 3");
  EXPECT_EQ(refusal_of(5, {{0, 1, 2, 3}, {1, -1, 3, 4}}), "tetrahedron 1 has vertex -1, but vertices are 0 to 4");
  EXPECT_EQ(refusal_with(12345, {1, 2, 20003, 4}), "tetrahedron 12345 has vertex 20003, but vertices are 0 to 20002");
}

TEST(MeshValidation, refuses_a_vertex_that_only_64_bits_hold) {
  const Kokkos::View<std::int64_t* [4], Kokkos::LayoutRight, HostMemory> tetrahedra("tetrahedra", 1);
  for (int corner = 0; corner < 4; ++corner) tetrahedra(0, corner) = corner;
  tetrahedra(0, 2) = (std::int64_t(1) << 32) + 2;
  try {
    const Mesh mesh(Tetrahedra<std::int64_t, HostMemory>(tetrahedra), segmentation_by({0, 0, 0, 0}));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "tetrahedron 0 has vertex 4294967298, but vertices are 0 to 3");
  }
}

TEST(MeshValidation, refuses_a_repeated_vertex) {
  EXPECT_EQ(refusal_of(4, {{3, 1, 2, 3}}), "tetrahedron 0 has vertex 3 twice");
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      std::array<Id, 4> quad = {10, 11, 12, 13};
      quad[b] = quad[a] = 15;
      EXPECT_EQ(refusal_with(7, quad), "tetrahedron 7 has vertex 15 twice");
    }
  }
}

TEST(MeshValidation, refuses_the_same_tetrahedron_twice_whatever_its_order) {
  EXPECT_EQ(refusal_of(5, {{0, 1, 2, 3}, {1, 2, 3, 4}, {3, 0, 2, 1}}),
            "tetrahedra 0 and 2 have the same four vertices");
  EXPECT_EQ(refusal_with(19000, {503, 501, 500, 502}), "tetrahedra 500 and 19000 have the same four vertices");
}

TEST(MeshValidation, names_the_first_of_several_faults) {
  EXPECT_EQ(refusal_of(4, {{0, 1, 2, 3}, {0, 0, 1, 2}, {0, 1, 2, 9}}), "tetrahedron 1 has vertex 0 twice");
  EXPECT_EQ(refusal_of(5, {{0, 1, 2, 3}, {1, 2, 3, 4}, {4, 3, 2, 1}, {3, 2, 1, 0}, {0, 2, 1, 3}}),
            "tetrahedra 1 and 2 have the same four vertices");
}

TEST(MeshValidation, accepts_what_is_unusual_but_legal) {
  EXPECT_EQ(refusal_of(mesh_named("three_on_one_triangle")), "accepted");
  EXPECT_EQ(refusal_of(mesh_named("isolated_vertices")), "accepted");
  EXPECT_EQ(refusal_of(mesh_named("two_sharing_a_vertex")), "accepted");
  EXPECT_EQ(refusal_of(mesh_named("several_components")), "accepted");
  EXPECT_EQ(refusal_of(mesh_named("coincident_points")), "accepted");
}

}  // namespace gale::test
