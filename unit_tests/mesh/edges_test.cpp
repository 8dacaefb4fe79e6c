#include <gtest/gtest.h>

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

/// Both ways to the edges of a mesh find those of its tables.
void expect_edges(const Mesh& mesh) {
  const auto tables = mesh.simplices({Enumeration::edges, false, true});
  const HostExecutionSpace space;
  const auto stars = detail::find_middle_stars(space, tables);
  const std::vector<Id> begin(tables.edge_begin.data(), tables.edge_begin.data() + mesh.vertices() + 1),
      high(tables.edge_high.data(), tables.edge_high.data() + mesh.known_edges());
  for (const auto& found : {detail::edges_by_lanes(space, tables, stars), detail::edges_by_threads(tables, stars)}) {
    EXPECT_EQ(to_vector(found.offsets), begin);
    EXPECT_EQ(to_vector(found.entries), high);
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

TEST_P(EdgesOf, every_mesh_are_found_by_lanes_and_by_threads) { expect_edges(encode(input(), segmentation())); }

INSTANTIATE_TEST_SUITE_P(Tests, EdgesOf, every_mesh_and_segmentation(), mesh_and_segmentation);

/// As many as a lane keeps by itself, or more, beside vertices of few.
TEST(Edges, of_a_vertex_may_be_many) {
  for (const Id degree : {38, 39, 40, 41, 42, 120}) {
    const InputMesh input = cone_over_caps(degree, 2);
    expect_edges(encode(input, segmentation_by(std::vector<std::int64_t>(input.points.size(), 0))));
  }
}

TEST(Edges, of_long_rows_lie_side_by_side) {
  for (const int caps : {2, 50}) expect_edges(encode(cone_over_caps(200, caps), 100));
}

}  // namespace gale::test
