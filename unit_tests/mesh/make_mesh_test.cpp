#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "support/arrays.hpp"
#include "support/input_mesh.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

const InputMesh& input() { return mesh_named("holed_grid_9"); }

template <class View>
View filled_points() {
  const View view("points", input().points.size(), 3);
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < view.extent(0); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      host(i, axis) = static_cast<typename View::value_type>(input().points[i][axis]);
  }
  Kokkos::deep_copy(view, host);
  return view;
}

template <class View>
View filled_tetrahedra() {
  const View view("tetrahedra", input().tetrahedra.size(), 4);
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < view.extent(0); ++i) {
    for (int corner = 0; corner < 4; ++corner)
      host(i, corner) = static_cast<typename View::value_type>(input().tetrahedra[i][corner]);
  }
  Kokkos::deep_copy(view, host);
  return view;
}

std::vector<Id> vertices_of_tetrahedra(const Mesh& mesh) {
  const Id* const first = mesh.encoded().cells.data();
  return {first, first + std::size_t(4) * mesh.cells()};
}

/// Is it the mesh that Mesh itself makes of the same points and tetrahedra?
void expect_the_same(const Mesh& mesh) {
  const Mesh expected(tetrahedra_of<std::int32_t>(input()), octree_segmentation(points_of<double>(input()), 20));
  EXPECT_EQ(vertices_of_tetrahedra(mesh), vertices_of_tetrahedra(expected));
  EXPECT_EQ(to_vector(mesh.vertex_input()), to_vector(expected.vertex_input()));
  EXPECT_EQ(to_vector(mesh.vertex_begin()), to_vector(expected.vertex_begin()));
}

template <class T, class Layout, class Memory>
using Matrix = Kokkos::View<T**, Layout, Memory>;

template <class Index, class Layout, class Memory>
void expect_the_same_from() {
  expect_the_same(make_mesh(filled_points<Matrix<double, Layout, Memory>>(),
                            filled_tetrahedra<Matrix<Index, Layout, Memory>>(), 20));
}

}  // namespace

TEST(MakeMesh, takes_any_layout_memory_and_integer) {
  expect_the_same_from<std::int32_t, Kokkos::LayoutRight, HostMemory>();
  expect_the_same_from<std::int64_t, Kokkos::LayoutLeft, HostMemory>();
  expect_the_same_from<std::uint32_t, Kokkos::LayoutRight, HostMemory>();
  expect_the_same_from<long long, Kokkos::LayoutRight, HostMemory>();
  expect_the_same_from<std::int16_t, Kokkos::LayoutLeft, HostMemory>();
  expect_the_same_from<std::int32_t, Kokkos::LayoutLeft, WorkerMemory>();
  expect_the_same_from<std::int64_t, Kokkos::LayoutRight, WorkerMemory>();
}

TEST(MakeMesh, takes_every_second_column_of_a_larger_view) {
  const auto points = filled_points<Matrix<double, Kokkos::LayoutRight, HostMemory>>();
  const Matrix<double, Kokkos::LayoutRight, HostMemory> wide("wide", points.extent(0), 7);
  const auto part = Kokkos::subview(wide, Kokkos::ALL(), std::make_pair(2, 5));
  Kokkos::deep_copy(part, points);
  expect_the_same(make_mesh(part, filled_tetrahedra<Matrix<Id, Kokkos::LayoutRight, HostMemory>>(), 20));
}

TEST(MakeMesh, takes_vectors) {
  std::vector<double> points;
  for (const auto& point : input().points) points.insert(points.end(), point.begin(), point.end());
  std::vector<std::int64_t> tetrahedra;
  for (const auto& tetrahedron : input().tetrahedra)
    tetrahedra.insert(tetrahedra.end(), tetrahedron.begin(), tetrahedron.end());
  expect_the_same(make_mesh(points, tetrahedra, 20));
}

TEST(MakeMesh, takes_floats) {
  const Mesh mesh = make_mesh(filled_points<Matrix<float, Kokkos::LayoutLeft, HostMemory>>(),
                              filled_tetrahedra<Matrix<Id, Kokkos::LayoutLeft, HostMemory>>());
  EXPECT_EQ(mesh.vertices(), input().vertices());
}

TEST(MakeMesh, refuses_other_shapes) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_THROW(make_mesh(points, std::vector<Id>{0, 1, 2}), Error) << "no multiple of 4";
  EXPECT_THROW(make_mesh(std::vector<double>{0, 0}, std::vector<Id>{0, 1, 2, 3}), Error) << "no multiple of 3";
  EXPECT_THROW(make_mesh(points, std::vector<Id>{0, 1, 2, 4}), Error) << "there is no vertex 4";
  const Matrix<double, Kokkos::LayoutRight, HostMemory> flat("flat", 4, 2);
  const Matrix<Id, Kokkos::LayoutRight, HostMemory> one("one", 1, 4);
  EXPECT_THROW(make_mesh(flat, one), Error) << "two columns";
}

TEST(MakeMesh, refuses_types_that_8_bits_do_not_hold) {
  const auto points = filled_points<Matrix<double, Kokkos::LayoutRight, HostMemory>>();
  const Kokkos::View<Id*, HostMemory> corners("corners", 4);
  const Kokkos::View<Offset*, HostMemory> offsets("offsets", 2);
  const Kokkos::View<int*, HostMemory> types("types", 1);
  for (Id k = 0; k < 4; ++k) corners(k) = k;
  offsets(1) = 4;
  for (const int type : {266, -246}) {
    types(0) = type;
    EXPECT_EQ(message_of([&] { make_mesh(points, corners, offsets, types); }),
              "cell 0 has the type " + std::to_string(type) + ", which is none of VTK's");
  }
}

}  // namespace gale::test
