#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/mesh/numbering/candidates.hpp>
#include <gale/mesh/numbering/enumerate.hpp>

#include "support/arrays.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using detail::FewDistinct;

std::vector<Id> ids_in(const FewDistinct& few) {
  std::vector<Id> ids;
  for (Id i = 0; i < few.size(); ++i) ids.push_back(few[i]);
  return ids;
}

std::vector<Id> consecutive(Id first, Id count) {
  std::vector<Id> ids;
  for (Id i = 0; i < count; ++i) ids.push_back(first + i);
  return ids;
}

void expect_same(const Mirrored<Id>& found, const Mirrored<Id>& expected) {
  EXPECT_EQ(to_vector(found.in<HostMemory>()), to_vector(expected.in<HostMemory>()));
}

/// Both ways to the edges and triangles of a mesh find those of its tables.
void expect_edges(const Mesh& mesh) {
  const auto tables = mesh.simplices({Enumeration::triangles, false, true});
  const auto& encoded = mesh.encoded();
  const HostExecutionSpace space;
  detail::SimplexTables by_lanes, by_segments, edges_first;
  const auto stars = detail::find_middle_stars(space, tables);
  detail::enumerate_edges(space, tables, stars, by_lanes);
  detail::enumerate_triangles(space, tables, stars, by_lanes);
  detail::enumerate_by_segments(encoded, tables.cell_begin, true, by_segments);
  detail::enumerate_by_segments(encoded, tables.cell_begin, false, edges_first);
  EXPECT_EQ(edges_first.triangle_begin.size(), 0u);
  detail::enumerate_by_segments(encoded, tables.cell_begin, true, edges_first);
  EXPECT_EQ(to_vector(by_lanes.edge_high.in<HostMemory>()),
            std::vector<Id>(tables.edge_high.data(), tables.edge_high.data() + mesh.known_edges()));
  EXPECT_EQ(to_vector(by_lanes.triangle_apex.in<HostMemory>()),
            std::vector<Id>(tables.triangle_apex.data(), tables.triangle_apex.data() + mesh.known_triangles()));
  for (const detail::SimplexTables* found : {&by_segments, &edges_first}) {
    expect_same(found->edge_begin, by_lanes.edge_begin);
    expect_same(found->edge_low, by_lanes.edge_low);
    expect_same(found->edge_high, by_lanes.edge_high);
    expect_same(found->triangle_begin, by_lanes.triangle_begin);
    expect_same(found->triangle_apex, by_lanes.triangle_apex);
  }
}

}  // namespace

TEST(FewDistinct, are_in_order_and_once) {
  FewDistinct few;
  EXPECT_EQ(few.size(), 0);
  for (const Id id : {5, 3, 9, 3, 5, 9, 0, 7, 0}) few.insert(id);
  EXPECT_EQ(ids_in(few), (std::vector<Id>{0, 3, 5, 7, 9}));
}

TEST(FewDistinct, are_as_many_as_fit_however_often_they_come) {
  FewDistinct few;
  for (int again = 0; again < 3; ++again) {
    for (Id i = 0; i < FewDistinct::capacity; ++i) few.insert(i * 7 % FewDistinct::capacity);
  }
  EXPECT_EQ(ids_in(few), consecutive(0, FewDistinct::capacity));
}

TEST(FewDistinct, are_too_many_from_one_more_on) {
  for (const Id one_more : {-1, 17, 2 * FewDistinct::capacity}) {
    FewDistinct few;
    for (Id i = 0; i < FewDistinct::capacity; ++i) few.insert(2 * i);
    few.insert(16);
    EXPECT_EQ(few.size(), FewDistinct::capacity);
    few.insert(one_more);
    EXPECT_EQ(few.size(), FewDistinct::too_many) << one_more;
    few.insert(16);
    EXPECT_EQ(few.size(), FewDistinct::too_many) << "it stays so";
  }
}

class EdgesOf : public EveryMesh {};

TEST_P(EdgesOf, every_mesh_are_found_by_lanes_and_by_segments) { expect_edges(encode(input(), segmentation())); }

INSTANTIATE_TEST_SUITE_P(Tests, EdgesOf, every_mesh_and_segmentation(), mesh_and_segmentation);

/// As many as a lane keeps by itself, or more, beside vertices of few.
TEST(Edges, of_a_vertex_may_be_many) {
  for (const Id degree : {31, 32, 33, 38, 39, 40, 41, 42, 120}) {
    const InputMesh input = cone_over_caps(degree, 2);
    expect_edges(encode(input, segmentation_by(std::vector<std::int64_t>(input.points.size(), 0))));
  }
}

TEST(Edges, are_the_same_of_several_threads) {
  const InputMesh input = holed_grid(24);
  const int before = host_threads();
  for (const int threads : {1, 3}) {
    set_host_threads(threads);
    expect_edges(encode(input, octree_of(input, 20)));
  }
  set_host_threads(before);
}

TEST(Edges, of_long_rows_lie_side_by_side) {
  for (const int caps : {2, 50}) expect_edges(encode(cone_over_caps(200, caps), 100));
}

}  // namespace gale::test
