#include <gtest/gtest.h>

#include <gale/algorithms/surface_vertices.hpp>

#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

/// By input id.
std::vector<std::uint8_t> surface_of(const InputMesh& input, const Segmentation& segmentation) {
  const Mesh mesh = encode(input, segmentation);
  const auto by_internal = surface_vertices(mesh);
  std::vector<std::uint8_t> by_input(input.points.size());
  for (Id v = 0; v < mesh.vertices(); ++v) by_input[mesh.vertex_input()(v)] = by_internal(v);
  return by_input;
}

}  // namespace

class SurfaceOf : public EveryMesh {};

TEST_P(SurfaceOf, every_mesh_is_that_of_brute_force) {
  EXPECT_EQ(surface_of(input(), segmentation()), brute_force_of(mesh_name()).on_surface);
}

INSTANTIATE_TEST_SUITE_P(Tests, SurfaceOf, every_mesh_and_segmentation(), mesh_and_segmentation);

/// The apex of the cone touches triangles with two tetrahedra, or three where there are three caps.
TEST(Surface, of_a_cone_over_caps_is_all_but_its_apex) {
  for (const int caps : {2, 3}) {
    for (const Id degree : {6, 63, 64, 65, 300}) {
      const InputMesh input = cone_over_caps(degree, caps);
      std::vector<std::uint8_t> expected(degree + 1, 1);
      expected[0] = 0;
      EXPECT_EQ(surface_of(input, octree_of(input, 100)), expected) << caps << " caps, degree " << degree;
    }
  }
}

TEST(Surface, of_a_cone_over_a_disc_is_everything) {
  for (const Id degree : {3, 64, 65, 300}) {
    const InputMesh input = cone_over_disc(degree);
    EXPECT_EQ(surface_of(input, octree_of(input, 100)), std::vector<std::uint8_t>(degree + 1, 1))
        << "degree " << degree;
  }
}

/// Two boundaries of a 4-simplex that share a tetrahedron: its triangles have three tetrahedra, all others two.
TEST(Surface, is_no_triangle_of_three_tetrahedra) {
  InputMesh input;
  input.points.resize(6);
  const Id spheres[2][5] = {{0, 1, 2, 3, 4}, {0, 1, 2, 3, 5}};
  for (const auto& sphere : spheres) {
    for (int left_out = 0; left_out < 5; ++left_out) {
      std::array<Id, 4> quad{};
      for (int i = 0, corner = 0; i < 5; ++i) {
        if (i != left_out) quad[corner++] = sphere[i];
      }
      if (left_out < 4 || &sphere == &spheres[0]) input.tetrahedra.push_back(quad);
    }
  }
  EXPECT_EQ(surface_of(input, segmentation_by({0, 0, 0, 1, 1, 1})), std::vector<std::uint8_t>(6, 0));
}

}  // namespace gale::test
