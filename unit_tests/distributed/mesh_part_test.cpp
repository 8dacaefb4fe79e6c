#include <memory>

#include <gtest/gtest.h>

#include <gale/distributed/distributed_mesh.hpp>

#include "support/message_of.hpp"

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

/// Cells of a rank that has none may have any number of corners.
TEST(MeshPart, has_cells_of_three_or_four_vertices) {
  const Tetrahedron<Kokkos::View<double**, HostMemory>> given;
  const auto cells_of = [&](std::size_t count, std::size_t corners) {
    return make_part(given.ids, given.points,
                     Kokkos::View<int**, Kokkos::LayoutLeft, HostMemory>("cells", count, corners))
        .cells;
  };
  for (const std::size_t corners : {3, 4}) EXPECT_EQ(cells_of(2, corners).extent(1), corners);
  EXPECT_EQ(cells_of(0, 0).extent(0), 0u);
  EXPECT_EQ(message_of([&] { cells_of(1, 5); }), "tetrahedra have 5 columns, not 4");
}

/// Points that are laid out as GALE reads them are shared, others copied; either way they are there when asked for.
TEST(MeshPart, keeps_points_that_their_caller_gives_up) {
  expect_kept<Kokkos::View<float**, Kokkos::LayoutRight, HostMemory>>(false);
  expect_kept<Kokkos::View<double**, Kokkos::LayoutRight, HostMemory>>(false);
  expect_kept<Kokkos::View<double**, Kokkos::LayoutLeft, HostMemory>>(true);
  expect_kept<Kokkos::View<int**, Kokkos::LayoutRight, HostMemory>>(true);
}

}  // namespace gale::test
