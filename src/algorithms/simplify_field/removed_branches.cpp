#include <algorithm>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/algorithms/merge_tree/vertex_arcs.hpp>
#include <gale/algorithms/simplify_field/removed_branches.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// A vertex that goes with a branch.
struct VertexInBranch {
  Id vertex, branch;
};

template <class Memory>
ExtremumGraphSide<Memory> copy_in(const ExtremumGraphSide<Memory>& graph, const ChangingRoom<Memory>& room) {
  ExtremumGraphSide<Memory> copy = graph;
  copy.next = first_of(room.places, graph.next.extent(0));
  Kokkos::deep_copy(copy.next, graph.next);
  return copy;
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

/// Finds the vertices of branches. `leaf` is of each extremum that goes, by place, its node; `branch` has the ends of
/// paths, and the number of each vertex's branch then.
template <class Space>
void find_vertices(const Space& space, const SideKeys& keys, const LiftedTree<MemoryOf<Space>>& tree,
                   const std::vector<Id>& leaves, const std::vector<Id>& numbers,
                   const Array<Id, MemoryOf<Space>>& branch, const Array<Id, MemoryOf<Space>>& place,
                   std::vector<FilledBranch>& branches) {
  using Memory = MemoryOf<Space>;
  const auto leaf = in_memory<Memory>(leaves), number = in_memory<Memory>(numbers);
  const auto count = static_cast<Offset>(branch.extent(0));
  parallel_for(
      "GALE::branches_of_vertices", space, count, KOKKOS_LAMBDA(Offset v) {
        const Id from = leaf(place_of_end(branch(v)));
        branch(v) = from == no_id ? no_id : number(tree.climb(from, keys[static_cast<Id>(v)]));
      });
  const Id total = exclusive_scan(
      "GALE::count_in_branches", space, count, place, KOKKOS_LAMBDA(Offset v) { return Id(branch(v) != no_id); });
  const auto found = allocate<Array<VertexInBranch, Memory>>("GALE::vertices_in_branches", total);
  parallel_for(
      "GALE::collect_in_branches", space, count, KOKKOS_LAMBDA(Offset v) {
        if (branch(v) != no_id) found(place(v)) = {static_cast<Id>(v), branch(v)};
      });
  space.fence();
  const auto here = on_host(found);
  for (Id i = 0; i < total; ++i) branches[here(i).branch].vertices.push_back(here(i).vertex);
}

}  // namespace

template <class Space>
RemovedBranches removed_branches(ChangingOrder<Space>& order, Side side, const ChooseExtrema& staying,
                                 const ChangingRoom<MemoryOf<Space>>& room) {
  using Memory = MemoryOf<Space>;
  const auto& graph = order.graph();
  auto of_side = copy_in(graph[side], room);
  std::vector<Id> others = graph[opposite(side)].extrema;
  const auto compared = ComparedVertices::numbered({&of_side.extrema, &others}, {&of_side.meetings},
                                                   [&](const std::vector<Id>& some) { return order.keys_of(some); });
  const auto paths = follow_paths(order.space(), side, compared, std::move(of_side));
  MergeForest forest = merge_forest(order.space(), side, compared, paths, others);
  const std::vector<std::uint64_t> keys_of_nodes = compared.keys_at(forest.vertices, side);
  forest.vertices = compared.at(forest.vertices);  // from here on GALE's
  std::vector<bool> stays = staying(side, forest);
  keep_one_of_each(forest, stays);
  RemovedBranches removed;
  removed.extrema = static_cast<Id>(stays.size());
  removed.unwanted = static_cast<Id>(std::count(stays.begin(), stays.end(), false));
  if (removed.unwanted == 0) return removed;
  const std::vector<Id> number = number_branches(forest, stays, removed.branches);
  std::vector<Id> leaf = forest.leaf;
  for (std::size_t place = 0; place < leaf.size(); ++place) {
    if (stays[place]) leaf[place] = no_id;
  }
  find_vertices(order.space(), SideKeys(order.keys(), side), lifted_tree<Memory>(keys_of_nodes, forest.parent), leaf,
                number, paths.ends, room.vertices_before, removed.branches);
  return removed;
}

#define GALE_INSTANTIATE(Space)                                                                       \
  template RemovedBranches removed_branches<Space>(ChangingOrder<Space>&, Side, const ChooseExtrema&, \
                                                   const ChangingRoom<MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
