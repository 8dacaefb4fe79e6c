#include <algorithm>

#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/mesh/encode.hpp>

#include "support/arrays.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Quads = std::vector<std::array<Id, 4>>;

Quads quads_of(const Array<Quad, HostMemory>& tetrahedra) {
  Quads quads;
  for (std::size_t t = 0; t < tetrahedra.extent(0); ++t)
    quads.push_back({tetrahedra(t).a, tetrahedra(t).b, tetrahedra(t).c, tetrahedra(t).d});
  return quads;
}

/// What a device does, done on the host, and what the host does are the same, on any number of threads.
template <class Index>
void expect_both_ways(const InputMesh& mesh, const Segmentation& segmentation) {
  const auto input = tetrahedra_of<Index>(mesh);
  const auto encoded = encode(mesh, segmentation);
  const auto& internal = encoded.vertex_internal();
  const Array<Id, HostMemory> vertex_internal("vertex_internal", internal.extent(0));
  Kokkos::deep_copy(vertex_internal, internal);
  const HostExecutionSpace space;
  const auto sorted = detail::sort_cells_by_vertices<4, HostExecutionSpace, Index>(space, input, vertex_internal);
  const auto external =
      detail::find_external_cells<HostExecutionSpace>(space, sorted.of_lowest, encoded.vertex_begin());
  const int before = host_threads();
  for (const int threads : {1, 3}) {
    set_host_threads(threads);
    const auto found = detail::encode_by_groups<4, Index>(input, vertex_internal, encoded.vertex_begin());
    EXPECT_EQ(quads_of(found.sorted.of_lowest.entries), quads_of(sorted.of_lowest.entries));
    EXPECT_EQ(to_vector(found.sorted.of_lowest.offsets), to_vector(sorted.of_lowest.offsets));
    EXPECT_EQ(to_vector(found.sorted.input), to_vector(sorted.input));
    EXPECT_EQ(to_vector(found.external.offsets), to_vector(external.offsets));
    EXPECT_EQ(to_vector(found.external.entries), to_vector(external.entries));
  }
  set_host_threads(before);
}

}  // namespace

class EncodingOf : public EveryMesh {};

TEST_P(EncodingOf, every_mesh_is_the_same_by_vertices_and_by_groups) {
  expect_both_ways<std::int32_t>(input(), segmentation());
  expect_both_ways<std::int64_t>(input(), segmentation());
}

INSTANTIATE_TEST_SUITE_P(Tests, EncodingOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(Encoding, of_more_vertices_than_a_group_has) {
  for (const int side : {7, 24}) {
    const InputMesh mesh = holed_grid(side);
    expect_both_ways<std::int32_t>(mesh, octree_of(mesh, 20));
  }
}

TEST(Encoding, of_cells_that_touch_more_segments_than_a_team_tells_apart) {
  const InputMesh mesh = holed_grid(12);
  expect_both_ways<std::int32_t>(mesh, octree_of(mesh, 1));
}

TEST(Encoding, of_a_vertex_that_is_lowest_of_many) {
  const InputMesh mesh = cone_over_caps(120, 50);
  expect_both_ways<std::int32_t>(mesh, octree_of(mesh, 20));
}

/// A mesh whose cells come as `encode` numbers them, in one segment, so that vertices keep their ids.
InputMesh in_order(InputMesh mesh) {
  for (auto& cell : mesh.tetrahedra) std::sort(cell.begin(), cell.end());
  std::sort(mesh.tetrahedra.begin(), mesh.tetrahedra.end());
  return mesh;
}

Segmentation one_segment(const InputMesh& mesh) {
  const Id vertices = static_cast<Id>(mesh.points.size());
  Segmentation segmentation;
  segmentation.vertex_input = iota("vertex_input", HostExecutionSpace(), vertices);
  const Array<Id, HostMemory> begin("vertex_begin", 2);
  begin(1) = vertices;
  segmentation.vertex_begin = begin;
  return segmentation;
}

TEST(Encoding, of_cells_that_come_in_order_and_nearly_so) {
  InputMesh mesh = in_order(holed_grid(16));
  ASSERT_GT(mesh.tetrahedra.size(), 3 * 4096u);  // some for each of three threads
  mesh.points.resize(mesh.points.size() + 5);    // vertices without cells
  expect_both_ways<std::int32_t>(mesh, one_segment(mesh));
  const std::size_t third = mesh.tetrahedra.size() / 3;  // where the second thread's part begins
  for (const std::size_t at : {third - 1, third, 2 * third, mesh.tetrahedra.size() - 2}) {
    InputMesh swapped = mesh;
    std::swap(swapped.tetrahedra[at], swapped.tetrahedra[at + 1]);
    expect_both_ways<std::int64_t>(swapped, one_segment(swapped));
  }
  std::rotate(mesh.tetrahedra.begin(), mesh.tetrahedra.end() - 1, mesh.tetrahedra.end());
  expect_both_ways<std::int32_t>(mesh, one_segment(mesh));
}

TEST(Encoding, of_cells_in_order_refuses_what_is_wrong_with_the_last_ones) {
  const InputMesh good = in_order(holed_grid(16));
  const int before = host_threads();
  set_host_threads(3);
  InputMesh twice = good;
  twice.tetrahedra.push_back(twice.tetrahedra.back());
  EXPECT_THROW(encode(twice, one_segment(twice)), Error);
  InputMesh outside = good;
  outside.tetrahedra.back()[3] = static_cast<Id>(outside.points.size());
  EXPECT_THROW(encode(outside, one_segment(outside)), Error);
  set_host_threads(before);
}

}  // namespace gale::test
