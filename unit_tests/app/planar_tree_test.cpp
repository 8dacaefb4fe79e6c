#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <gale/app/drawing/planar_tree.hpp>

namespace gale::app {

namespace {

/// A tree whose nodes are its own vertices, at the heights 0, 1, 2, ...
MergeTree tree_of(Id nodes, const std::vector<MergeArc>& arcs) {
  MergeTree tree;
  tree.vertices.resize(nodes);
  std::iota(tree.vertices.begin(), tree.vertices.end(), Id(0));
  tree.arcs = arcs;
  return tree;
}

std::vector<double> heights_of(const MergeTree& tree) { return {tree.vertices.begin(), tree.vertices.end()}; }

/// The node that is drawn at a place.
Id node_at(const PlanarTree& planar, const PlanarTree::Place& place) {
  const auto found =
      std::find_if(planar.nodes.begin(), planar.nodes.end(), [&](const auto& node) { return node.place == place; });
  return found == planar.nodes.end() ? no_id : found->node;
}

std::vector<std::pair<Id, Id>> ends_of(const PlanarTree& planar) {
  std::vector<std::pair<Id, Id>> ends;
  for (const auto& path : planar.arcs) ends.emplace_back(node_at(planar, path.front()), node_at(planar, path.back()));
  return ends;
}

/// Minima 0 and 1 join in 2, and 4 splits: to the maxima 5 and 7 by way of 6, from which another one, 8, goes.
const MergeTree& small_tree() {
  static const MergeTree tree =
      tree_of(9, {{0, 2, 0}, {1, 2, 0}, {2, 4, 0}, {4, 5, 0}, {4, 6, 0}, {6, 7, 0}, {6, 8, 0}});
  return tree;
}

}  // namespace

TEST(PlanarTree, shows_each_arc_between_its_nodes) {
  const PlanarTree planar = planar_tree(small_tree(), heights_of(small_tree()), 100);
  EXPECT_EQ(planar.branches, 4);
  EXPECT_EQ(planar.shown, 4);
  EXPECT_EQ(planar.nodes.size(), 8u) << "all but 3, which has no arcs";
  const auto ends = ends_of(planar);
  ASSERT_EQ(ends.size(), 7u);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const MergeArc& arc = small_tree().arcs[i];
    EXPECT_EQ(ends[planar.arc_of[i]], std::pair(arc.lower, arc.upper));
  }
}

TEST(PlanarTree, has_minima_on_the_left_and_maxima_on_the_right) {
  const PlanarTree planar = planar_tree(small_tree(), heights_of(small_tree()), 100);
  std::vector<Id> leaves;
  auto nodes = planar.nodes;
  std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.place[0] < b.place[0]; });
  for (const auto& node : nodes) {
    EXPECT_EQ(node.place[1], node.node);
    if (node.node != 2 && node.node != 4 && node.node != 6 && node.node != 8) leaves.push_back(node.node);
  }
  EXPECT_EQ(leaves, (std::vector<Id>{1, 0, 7, 5})) << "0 is below 8, on the longest way";
}

TEST(PlanarTree, leaves_out_what_persists_least) {
  const PlanarTree planar = planar_tree(small_tree(), heights_of(small_tree()), 1);
  EXPECT_EQ(planar.branches, 4);
  EXPECT_EQ(planar.shown, 1);
  EXPECT_EQ(ends_of(planar), (std::vector<std::pair<Id, Id>>{{0, 8}}));
  EXPECT_EQ(planar.arc_of, (std::vector<Id>(7, 0)));
  std::vector<Id> counts;
  for (const Id most : {2, 3})
    counts.push_back(static_cast<Id>(planar_tree(small_tree(), heights_of(small_tree()), most).arcs.size()));
  EXPECT_EQ(counts, (std::vector<Id>{3, 5}));
}

TEST(PlanarTree, of_a_forest_shows_its_longest_ways) {
  const MergeTree tree = tree_of(6, {{0, 1, 0}, {2, 5, 0}});
  EXPECT_EQ(ends_of(planar_tree(tree, heights_of(tree), 9)), (std::vector<std::pair<Id, Id>>{{0, 1}, {2, 5}}));
  const PlanarTree one = planar_tree(tree, heights_of(tree), 1);
  EXPECT_EQ(ends_of(one), (std::vector<std::pair<Id, Id>>{{2, 5}}));
  EXPECT_EQ(one.arc_of, (std::vector<Id>{no_id, 0}));
  EXPECT_EQ(planar_tree(tree_of(1, {}), {0}, 9).arcs.size(), 0u);
}

/// Joins new nodes to any earlier ones, and takes regular ones out.
static MergeTree random_tree(std::mt19937& random) {
  const Id count = 2 + static_cast<Id>(random() % 40);
  std::vector<MergeArc> arcs;
  for (Id node = 1; node < count; ++node) arcs.push_back({static_cast<Id>(random() % node), node, 0});
  for (Id node = 0; node < count; ++node) {
    const auto is_below = [&](const MergeArc& arc) { return arc.upper == node; };
    const auto is_above = [&](const MergeArc& arc) { return arc.lower == node; };
    if (std::count_if(arcs.begin(), arcs.end(), is_below) != 1 ||
        std::count_if(arcs.begin(), arcs.end(), is_above) != 1)
      continue;
    const auto above = std::find_if(arcs.begin(), arcs.end(), is_above);
    std::find_if(arcs.begin(), arcs.end(), is_below)->upper = above->upper;
    arcs.erase(above);
  }
  return tree_of(count, arcs);
}

TEST(PlanarTree, of_any_tree_has_its_arcs_and_stays_connected_with_less) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const MergeTree tree = random_tree(random);
    const PlanarTree all = planar_tree(tree, heights_of(tree), 100);
    const auto ends = ends_of(all);
    ASSERT_EQ(ends.size(), tree.arcs.size());
    for (std::size_t i = 0; i < tree.arcs.size(); ++i)
      ASSERT_EQ(ends[all.arc_of[i]], std::pair(tree.arcs[i].lower, tree.arcs[i].upper));
    for (const Id most : {1, 3, 7}) {
      const PlanarTree some = planar_tree(tree, heights_of(tree), most);
      ASSERT_EQ(some.shown, std::min(most, all.branches));
      ASSERT_EQ(some.nodes.size(), some.arcs.size() + 1);
      for (const Id arc : some.arc_of) ASSERT_TRUE(arc >= 0 && arc < static_cast<Id>(some.arcs.size()));
      for (const auto& [from, to] : ends_of(some)) ASSERT_TRUE(from != no_id && to != no_id);
    }
  }
}

}  // namespace gale::app
