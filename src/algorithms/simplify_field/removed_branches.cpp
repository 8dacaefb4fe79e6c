#include <algorithm>

#include <gale/algorithms/merge_tree/followed_paths.hpp>
#include <gale/algorithms/merge_tree/vertex_arcs.hpp>
#include <gale/algorithms/simplify_field/removed_branches.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

namespace {

FollowedPaths<HostMemory> follow(const SideKeys& keys, const ExtremumGraphSide<HostMemory>& graph,
                                 const ChangingRoom& room) {
  ExtremumGraphSide<HostMemory> copy = graph;
  copy.next = Kokkos::subview(room.places, std::make_pair(std::size_t(0), graph.next.extent(0)));
  parallel_for("GALE::copy_next", HostExecutionSpace(), static_cast<Offset>(graph.next.extent(0)),
               [&](Offset i) { copy.next(i) = graph.next(i); });
  return follow_paths(HostExecutionSpace(), keys, std::move(copy));
}

MergeForest forest_of(const SideKeys& keys, const FollowedPaths<HostMemory>& paths, const std::vector<Id>& others) {
  std::vector<Meeting> lasts;
  for (const Id vertex : others) lasts.push_back({vertex, place_of_end(paths.ends(vertex))});
  return merge_forest(keys, paths.extrema, paths.meetings, std::move(lasts));
}

/// The oldest of each component stays if no other one does.
void keep_one_of_each(const MergeForest& forest, std::vector<bool>& stays) {
  std::vector<bool> has_one(forest.size(), false);
  for (std::size_t place = 0; place < stays.size(); ++place) has_one[forest.leaf[place]] = stays[place];
  std::vector<Id> root(forest.size());
  for (Id node = forest.size() - 1; node >= 0; --node)
    root[node] = forest.parent[node] == no_id ? node : root[forest.parent[node]];
  for (Id node = 0; node < forest.size(); ++node) {
    if (has_one[node]) has_one[root[node]] = true;
  }
  for (std::size_t place = 0; place < stays.size(); ++place) {
    if (forest.branch_end[place] == no_id && !has_one[root[forest.leaf[place]]]) stays[place] = true;
  }
}

/// The number of the branch that each node's arc is removed with; no_id if it isn't.
std::vector<Id> number_branches(const MergeForest& forest, const std::vector<bool>& stays,
                                std::vector<FilledBranch>& branches) {
  std::vector<bool> is_left(forest.size(), false);
  for (std::size_t place = 0; place < stays.size(); ++place) {
    if (stays[place]) is_left[forest.leaf[place]] = true;
  }
  for (Id node = 0; node < forest.size(); ++node) {
    if (is_left[node] && forest.parent[node] != no_id) is_left[forest.parent[node]] = true;
  }
  std::vector<Id> number(forest.size(), no_id);
  for (Id node = forest.size() - 1; node >= 0; --node) {
    if (is_left[node]) continue;
    const Id parent = forest.parent[node];
    if (is_left[parent]) {
      number[node] = static_cast<Id>(branches.size());
      branches.push_back({forest.vertices[parent], {}});
    } else {
      number[node] = number[parent];
    }
  }
  return number;
}

}  // namespace

RemovedBranches removed_branches(const ChangingOrder& order, Side side, const ChooseExtrema& staying,
                                 const ChangingRoom& room) {
  const SideKeys keys(order.keys(), side);
  const auto paths = follow(keys, order.graph()[side], room);
  const MergeForest forest = forest_of(keys, paths, order.graph()[opposite(side)].extrema);
  std::vector<bool> stays = staying(side, forest);
  keep_one_of_each(forest, stays);
  RemovedBranches removed;
  removed.extrema = static_cast<Id>(stays.size());
  removed.unwanted = static_cast<Id>(std::count(stays.begin(), stays.end(), false));
  if (removed.unwanted == 0) return removed;
  const std::vector<Id> number = number_branches(forest, stays, removed.branches);
  const auto tree = lifted_tree<HostMemory>(keys, forest.vertices, forest.parent);
  const auto count = static_cast<Offset>(paths.ends.extent(0));
  const auto& branch = paths.ends;  // in place
  parallel_for("GALE::branches_of_vertices", HostExecutionSpace(), count, [&](Offset v) {
    const Id place = place_of_end(paths.ends(v));
    branch(v) = stays[place] ? no_id : number[tree.climb(forest.leaf[place], keys[static_cast<Id>(v)])];
  });
  for (Offset v = 0; v < count; ++v) {
    if (branch(v) != no_id) removed.branches[branch(v)].vertices.push_back(static_cast<Id>(v));
  }
  return removed;
}

}  // namespace gale::detail
