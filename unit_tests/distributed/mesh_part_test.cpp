#include <memory>

#include <gtest/gtest.h>

#include <gale/distributed/distributed_mesh.hpp>

namespace gale::test {

namespace {

/// One tetrahedron in Views of one's own.
template <class PointView>
struct Tetrahedron {
  Kokkos::View<std::int64_t*, HostMemory> ids{"ids", 4};
  PointView points{"points", 4, 3};
  Kokkos::View<int* [4], Kokkos::LayoutRight, HostMemory> tetrahedra { "tetrahedra", 1 };

  Tetrahedron() {
    for (int v = 0; v < 4; ++v) {
      ids(v) = v;
      tetrahedra(0, v) = v;
      for (int axis = 0; axis < 3; ++axis) points(v, axis) = v == axis + 1 ? 2 : 0;
    }
  }
};

template <class PointView>
void expect_kept(bool is_copied) {
  std::unique_ptr<const DistributedMesh> mesh;
  {
    const Tetrahedron<PointView> given;
    const auto part = make_part(given.ids, given.points, given.tetrahedra);
    EXPECT_EQ(given.points.use_count(), is_copied ? 1 : 2);
    mesh = std::make_unique<const DistributedMesh>(Communicator(MPI_COMM_SELF), part);
    EXPECT_EQ(given.points.use_count(), is_copied ? 1 : 3);
  }
  for (int v = 0; v < 4; ++v) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(mesh->points()(v, axis), v == axis + 1 ? 2 : 0);
  }
  EXPECT_EQ(mesh->vertex_of(3), 3);
  EXPECT_EQ(mesh->vertex_of(4), no_id);
  EXPECT_EQ(mesh->vertex_of(-1), no_id);
}

}  // namespace

/// Points that are laid out as GALE reads them are shared, others copied; either way they are there when asked for.
TEST(MeshPart, keeps_points_that_their_caller_gives_up) {
  expect_kept<Kokkos::View<float**, Kokkos::LayoutRight, HostMemory>>(false);
  expect_kept<Kokkos::View<double**, Kokkos::LayoutRight, HostMemory>>(false);
  expect_kept<Kokkos::View<double**, Kokkos::LayoutLeft, HostMemory>>(true);
  expect_kept<Kokkos::View<int**, Kokkos::LayoutRight, HostMemory>>(true);
}

}  // namespace gale::test
