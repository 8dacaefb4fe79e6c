#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/algorithms/merge_tree/contour_arcs.hpp>
#include <gale/algorithms/merge_tree/followed_paths.hpp>
#include <gale/algorithms/merge_tree/merge_forest.hpp>
#include <gale/algorithms/merge_tree/vertex_arcs.hpp>
#include <gale/algorithms/order/require_mesh.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/base/error.hpp>

namespace gale {

namespace detail {

namespace {

/// The field at one of GALE's vertices, where extrema are to be left out.
struct ThresholdOfTree {
  double least;
  std::function<double(Id)> value;
};

/// Makes trees of an extremum graph.
template <class Space>
class TreeMaker {
  using Memory = MemoryOf<Space>;

 public:
  TreeMaker(const Space& space, const VertexOrder& order, ExtremumGraph<Memory> graph, const std::vector<Tree>& trees)
      : space_(space), order_(order), trees_(trees) {
    const auto uses = [&](Tree one) {
      return std::any_of(trees.begin(), trees.end(), [&](Tree tree) { return tree == one || tree == Tree::contour; });
    };
    uses_ = {uses(Tree::join), uses(Tree::split)};
    std::array<std::vector<Id>, 2> extrema = {graph[below].extrema, graph[above].extrema};
    for (const Side side : {below, above}) {
      if (uses_[side]) grow(side, std::move(graph[side]), extrema[opposite(side)]);
    }
    choose_nodes();
  }

  std::vector<MergeTree> make(const ThresholdOfTree* threshold) {
    std::vector<MergeTree> made;
    std::vector<ArcsOfNodes> claims(trees_.size());
    for (std::size_t i = 0; i < trees_.size(); ++i)
      made.push_back(trees_[i] == Tree::contour
                         ? contour(claims[i])
                         : one_sided(trees_[i] == Tree::join ? below : above, threshold, claims[i]));
    auto arcs = arcs_of_vertices(space_, order_.mesh(), climbs_, claims);
    for (std::size_t i = 0; i < made.size(); ++i) set_arcs(made[i], std::move(arcs[i]));
    return made;
  }

 private:
  SideKeys keys(Side side) const { return {order_.keys(), side}; }
  SideKeys keys_there(Side side) const { return {order_.keys_in<Memory>().data(), side}; }

  void grow(Side side, ExtremumGraphSide<Memory> graph, const std::vector<Id>& others) {
    const auto paths = follow_paths(space_, keys(side), std::move(graph));
    const std::vector<Id> ends = extrema_of(space_, paths.ends, others);
    std::vector<Meeting> lasts;
    for (std::size_t i = 0; i < others.size(); ++i) lasts.push_back({others[i], ends[i]});
    forests_[side] = merge_forest(keys(side), paths.extrema, paths.meetings, std::move(lasts));
    ends_[side] = paths.ends;
  }

  SideClimb<Memory> climb(Side side, const std::vector<Id>& leaf, const std::vector<Id>& vertices,
                          const std::vector<Id>& parents) const {
    const auto copy = allocate<Array<Id, HostMemory>>("GALE::leaves", leaf.size());
    std::copy(leaf.begin(), leaf.end(), copy.data());
    return {keys_there(side), ends_[side], in_memory<Memory>(copy), lifted_tree<Memory>(keys(side), vertices, parents)};
  }

  /// The nodes of all that is made, those of both sides together, and the way of vertices to them.
  void choose_nodes() {
    for (const Side side : {below, above})
      nodes_.insert(nodes_.end(), forests_[side].vertices.begin(), forests_[side].vertices.end());
    std::sort(nodes_.begin(), nodes_.end(), keys(below));
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    for (const Side side : {below, above}) {
      if (!uses_[side]) continue;
      const MergeForest& forest = forests_[side];
      if (uses_[opposite(side)]) {
        base_[side] = nodes_of(space_, climb(side, forest.leaf, forest.vertices, forest.parent), nodes_);
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
        pruned(forest, threshold == nullptr ? std::vector<bool>(forest.leaf.size(), true)
                                            : persistent_extrema(forest, threshold->value, threshold->least));
    const auto count = static_cast<Id>(kept.nodes.size());
    const auto number = [&](Id place) { return side == below ? place : count - 1 - place; };
    std::vector<Id> vertices(count), arc_of(count, no_id), place;
    std::vector<std::pair<Id, Id>> ends;
    for (Id i = 0; i < count; ++i) {
      vertices[number(i)] = forest.vertices[kept.nodes[i]];
      if (kept.parent[i] == no_id) continue;
      arc_of[i] = static_cast<Id>(ends.size());
      const Id one = number(i), other = number(kept.parent[i]);
      ends.emplace_back(std::min(one, other), std::max(one, other));
    }
    MergeTree tree = tree_of(order_.mesh(), vertices, ends, place);
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
    MergeTree tree = tree_of(order_.mesh(), nodes_, arcs.ends, place);
    for (const Side side : {below, above}) {
      for (const Id by : arcs.taken_by[side])
        claims[side].push_back(by == ContourArcs::nobody ? no_claim : pair_key(by, place[by]));
    }
    return tree;
  }

  Space space_;
  const VertexOrder& order_;
  const std::vector<Tree> trees_;
  std::array<bool, 2> uses_;
  std::array<MergeForest, 2> forests_;
  std::array<Array<Id, Memory>, 2> ends_;
  std::vector<Id> nodes_;                ///< as they come in the order
  std::array<std::vector<Id>, 2> base_;  ///< of each, by side, the forest's node whose arc it begins or lies on
  std::array<std::vector<Id>, 2> parents_;
  std::array<SideClimb<Memory>, 2> climbs_;
};

/// What a threshold needs; throws gale::Error if it hasn't got it.
std::optional<ThresholdOfTree> threshold_of(const Mesh& mesh, const MergeTreeOptions& options) {
  if (options.threshold == 0) return std::nullopt;
  if (std::isnan(options.threshold)) throw Error("the threshold of a tree is no number");
  if (!options.value) throw Error("a tree simplified by persistence needs the field's values");
  const OtherIds input = mesh.vertices_in_input();
  return ThresholdOfTree{options.threshold, [input, &options](Id vertex) {
                           const double value = options.value(input[vertex]);
                           if (std::isnan(value))
                             throw Error("vertex " + std::to_string(input[vertex]) + " has no field value: it is NaN");
                           return value;
                         }};
}

/// Makes trees of an order as it is; but join and split trees as far as a threshold leaves them.
template <class Space>
std::vector<MergeTree> trees_of(const Space& space, const VertexOrder& order, ExtremumGraph<MemoryOf<Space>> graph,
                                const std::vector<Tree>& trees, const ThresholdOfTree* threshold) {
  return TreeMaker<Space>(space, order, std::move(graph), trees).make(threshold);
}

/// `make(order, trees, threshold)` makes trees as trees_of does.
template <class Make>
std::vector<MergeTree> find_trees(const VertexOrder& order, std::vector<Tree> trees, const MergeTreeOptions& options,
                                  Computed* computed, const Make& make) {
  require_whole_mesh("a merge tree", order.mesh());
  const auto threshold = threshold_of(order.mesh(), options);
  const bool simplifies = threshold && trees.back() == Tree::contour;
  if (simplifies) trees.pop_back();
  std::vector<MergeTree> found;
  if (!trees.empty()) found = make(order, trees, threshold ? &*threshold : nullptr);
  if (simplifies) {
    const SimplifiedField field = simplify_field(order, options.value, options.threshold, options, computed);
    const VertexOrder simplified(order.mesh(), field.rank.data(), field.rank.size());
    found.push_back(std::move(make(simplified, {Tree::contour}, nullptr).front()));
  }
  return found;
}

/// Finds trees where there is room.
std::vector<MergeTree> find_trees(const VertexOrder& order, const std::vector<Tree>& trees,
                                  const MergeTreeOptions& options, Computed* computed) {
  Computed own;
  Computed& shared = computed == nullptr ? own : *computed;  // one structure for all sweeps
  const auto make = [&](const VertexOrder& of, const std::vector<Tree>& some, const ThresholdOfTree* threshold) {
    return Computing(of.mesh(), options, &shared)
        .find(
            merge_tree_relations,
            [&](const DeviceSweepOptions& sweep) {
              const WorkerSpace space;
              return trees_of(space, of, extremum_graph(space, of, sweep), some, threshold);
            },
            [&](Structure& structure) {
              return trees_of(HostExecutionSpace(), of, extremum_graph(structure, of.keys(), options), some, threshold);
            });
  };
  return find_trees(order, trees, options, &shared, make);
}

const std::vector<Tree> all_trees = {Tree::join, Tree::split, Tree::contour};

std::array<MergeTree, 3> as_array(std::vector<MergeTree> found) {
  return {std::move(found[0]), std::move(found[1]), std::move(found[2])};
}

}  // namespace

}  // namespace detail

MergeTree find_merge_tree(const VertexOrder& order, Tree tree, const MergeTreeOptions& options, Computed* computed) {
  return std::move(detail::find_trees(order, {tree}, options, computed).front());
}

std::array<MergeTree, 3> find_merge_trees(const VertexOrder& order, const MergeTreeOptions& options,
                                          Computed* computed) {
  return detail::as_array(detail::find_trees(order, detail::all_trees, options, computed));
}

std::array<MergeTree, 3> find_merge_trees(const WorkerSpace& space, const VertexOrder& order,
                                          const MergeTreeOptions& options, const DeviceSweepOptions& sweep) {
  return detail::as_array(detail::find_trees(
      order, detail::all_trees, options, nullptr,
      [&](const VertexOrder& of, const std::vector<Tree>& trees, const detail::ThresholdOfTree* threshold) {
        return detail::trees_of(space, of, detail::extremum_graph(space, of, sweep), trees, threshold);
      }));
}

}  // namespace gale
