#pragma once

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/algorithms/merge_tree/merge_forest.hpp>
#include <gale/algorithms/merge_tree/vertex_arcs.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

/// The field at an input vertex, where extrema are to be left out.
struct ThresholdOfTree {
  double least;
  std::function<double(Id)> value;
};

/// Whether some of the trees are made of the paths of a side.
inline bool are_made_of(Side side, const std::vector<Tree>& trees) {
  const Tree of_side = side == below ? Tree::join : Tree::split;
  return std::any_of(trees.begin(), trees.end(), [&](Tree tree) { return tree == of_side || tree == Tree::contour; });
}

/// What trees are made of.
template <class Memory>
struct TreeParts {
  ExtremumGraph<Memory> graph;  ///< whose extrema, and vertices where paths meet, are places in `compared`
  ComparedVertices compared;
  std::vector<Id> input;                ///< the input vertex of each of these
  const std::uint64_t* keys = nullptr;  ///< of all vertices of the graph, where its arrays are
};

/// The parts of trees of a whole mesh. Keys that the host needs are fetched by themselves.
template <class Memory>
TreeParts<Memory> parts_of_trees(const VertexOrder& order, ExtremumGraph<Memory> graph,
                                 const std::vector<Tree>& trees) {
  std::vector<std::vector<Meeting>*> meetings;
  for (const Side side : {below, above}) {
    if (are_made_of(side, trees)) meetings.push_back(&graph[side].meetings);
  }
  TreeParts<Memory> parts;
  parts.compared = ComparedVertices::numbered({&graph[below].extrema, &graph[above].extrema}, meetings,
                                              [&](const std::vector<Id>& some) { return order.keys_of(some); });
  parts.input = order.mesh().input_of_vertices(parts.compared.vertices);
  parts.keys = order.keys_in<Memory>().data();
  parts.graph = std::move(graph);
  return parts;
}

/// Makes trees of an extremum graph.
template <class Space>
class TreeMaker {
  using Memory = MemoryOf<Space>;

 public:
  TreeMaker(const Space& space, TreeParts<Memory> parts, const std::vector<Tree>& trees)
      : space_(space),
        compared_(std::move(parts.compared)),
        input_(std::move(parts.input)),
        keys_(parts.keys),
        trees_(trees) {
    ExtremumGraph<Memory>& graph = parts.graph;
    uses_ = {are_made_of(below, trees), are_made_of(above, trees)};
    std::array<std::vector<Id>, 2> extrema = {graph[below].extrema, graph[above].extrema};
    for (const Side side : {below, above}) {
      if (uses_[side]) grow(side, std::move(graph[side]), extrema[opposite(side)]);
    }
    choose_nodes();
  }

  TreeMaker(const TreeMaker&) = delete;  // keys_ may be those of compared_
  TreeMaker& operator=(const TreeMaker&) = delete;

  /// Makes all trees of a mesh whose vertices are the graph's.
  std::vector<MergeTree> make(const Mesh& mesh, const ThresholdOfTree* threshold) const {
    std::vector<ArcsOfNodes> claims;
    std::vector<MergeTree> made = make_nodes(threshold, claims);
    find_arcs_of_vertices(space_, mesh, climbs_, claims, made);
    for (MergeTree& tree : made) set_arcs_of_nodes(tree);
    return made;
  }

  /// The trees without the arcs of vertices, which `claims` and climbs() lead to.
  std::vector<MergeTree> make_nodes(const ThresholdOfTree* threshold, std::vector<ArcsOfNodes>& claims) const {
    std::vector<MergeTree> made;
    claims.assign(trees_.size(), {});
    for (std::size_t i = 0; i < trees_.size(); ++i)
      made.push_back(trees_[i] == Tree::contour
                         ? contour(claims[i])
                         : one_sided(trees_[i] == Tree::join ? below : above, threshold, claims[i]));
    return made;
  }

  const std::array<SideClimb<Memory>, 2>& climbs() const { return climbs_; }
  bool uses(Side side) const { return uses_[side]; }

 private:
  void grow(Side side, ExtremumGraphSide<Memory> graph, const std::vector<Id>& others) {
    const auto paths = follow_paths(space_, side, compared_, std::move(graph));
    forests_[side] = merge_forest(space_, side, compared_, paths, others);
    ends_[side] = paths.ends;
  }

  SideClimb<Memory> climb(Side side, const std::vector<Id>& leaf, const std::vector<Id>& vertices,
                          const std::vector<Id>& parents) const {
    return {{keys_, side},
            ends_[side],
            in_memory<Memory>(array_of("GALE::leaves", leaf)),
            lifted_tree<Memory>(compared_.keys_at(vertices, side), parents)};
  }

  /// The nodes of all that is made, those of both sides together, and the way of vertices to them.
  void choose_nodes() {
    for (const Side side : {below, above})
      nodes_.insert(nodes_.end(), forests_[side].vertices.begin(), forests_[side].vertices.end());
    sort_distinct("GALE::sort_tree_nodes", nodes_);
    for (const Side side : {below, above}) {
      if (!uses_[side]) continue;
      const MergeForest& forest = forests_[side];
      if (uses_[opposite(side)]) {
        base_[side] = nodes_of(space_, climb(side, forest.leaf, forest.vertices, forest.parent), compared_.at(nodes_));
      } else {
        base_[side].resize(nodes_.size());
        std::iota(base_[side].begin(), base_[side].end(), Id(0));
        if (side == above) std::reverse(base_[side].begin(), base_[side].end());
      }
      parents_[side] = parents_among(side, forest, base_[side]);
      std::vector<Id> number(forest.vertices.size()), leaf;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (forest.vertices[base_[side][i]] == nodes_[i]) number[base_[side][i]] = static_cast<Id>(i);
      }
      for (const Id node : forest.leaf) leaf.push_back(number[node]);
      climbs_[side] = climb(side, leaf, nodes_, parents_[side]);
    }
  }

  MergeTree one_sided(Side side, const ThresholdOfTree* threshold, ArcsOfNodes& claims) const {
    const MergeForest& forest = forests_[side];
    const PrunedForest kept =
        pruned(forest, threshold == nullptr
                           ? std::vector<bool>(forest.leaf.size(), true)
                           : persistent_extrema(
                                 forest, [&](Id place) { return threshold->value(input_[place]); }, threshold->least));
    const auto count = static_cast<Id>(kept.nodes.size());
    const auto number = [&](Id place) { return side == below ? place : count - 1 - place; };
    std::vector<Id> vertices(count), arc_of(count, no_id), place;
    std::vector<std::pair<Id, Id>> ends;
    for (Id i = 0; i < count; ++i) {
      vertices[number(i)] = input_[forest.vertices[kept.nodes[i]]];
      if (kept.parent[i] == no_id) continue;
      arc_of[i] = static_cast<Id>(ends.size());
      const Id one = number(i), other = number(kept.parent[i]);
      ends.emplace_back(std::min(one, other), std::max(one, other));
    }
    MergeTree tree = tree_of(std::move(vertices), ends, place);
    for (Id i = 0; i < count; ++i) {
      if (arc_of[i] != no_id) arc_of[i] = place[arc_of[i]];
      // What hangs on a root belongs to an arc that ends there.
      if (kept.parent[i] != no_id && kept.parent[kept.parent[i]] == no_id) arc_of[kept.parent[i]] = arc_of[i];
    }
    for (const Id base : base_[side]) {
      const Id arc = arc_of[kept.place[base]];
      claims[side].push_back(arc == no_id ? no_claim : pair_key(0, arc));
    }
    return tree;
  }

  MergeTree contour(ArcsOfNodes& claims) const {
    const ContourArcs arcs = contour_arcs(parents_);
    std::vector<Id> place;
    std::vector<Id> vertices;
    for (const Id node : nodes_) vertices.push_back(input_[node]);
    MergeTree tree = tree_of(std::move(vertices), arcs.ends, place);
    for (const Side side : {below, above}) {
      for (const Id by : arcs.taken_by[side])
        claims[side].push_back(by == ContourArcs::nobody ? no_claim : pair_key(by, place[arcs.arc_of(by)]));
    }
    return tree;
  }

  Space space_;
  const ComparedVertices compared_;
  const std::vector<Id> input_;
  const std::uint64_t* const keys_;
  const std::vector<Tree> trees_;
  std::array<bool, 2> uses_;
  std::array<MergeForest, 2> forests_;
  std::array<Array<Id, Memory>, 2> ends_;
  std::vector<Id> nodes_;                ///< places among what is compared, ascending
  std::array<std::vector<Id>, 2> base_;  ///< of each, by side, the forest's node whose arc it begins or lies on
  std::array<std::vector<Id>, 2> parents_;
  std::array<SideClimb<Memory>, 2> climbs_;
};

}  // namespace gale::detail
