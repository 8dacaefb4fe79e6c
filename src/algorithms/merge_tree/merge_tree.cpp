#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/computed_graph.hpp>
#include <gale/algorithms/merge_tree/tree_maker.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/base/error.hpp>

namespace gale {

namespace detail {

namespace {

/// What a threshold needs; throws gale::Error if it hasn't got it. Collective.
std::optional<ThresholdOfTree> threshold_of(const MergeTreeOptions& options, const Ranks& ranks) {
  together(ranks, [&] {
    require_threshold(options.threshold);
    if (options.threshold != 0 && !options.value)
      throw Error("a tree simplified by persistence needs the field's values");
  });
  if (options.threshold == 0) return std::nullopt;
  return ThresholdOfTree{options.threshold,
                         [&options](Id vertex) { return detail::known_value(options.value(vertex), vertex); }};
}

/// Makes trees of an order as it is; but join and split trees as far as a threshold leaves them.
template <class Space>
std::vector<MergeTree> trees_of(const Space& space, const VertexOrder& order, ExtremumGraph<MemoryOf<Space>> graph,
                                const std::vector<Tree>& trees, const ThresholdOfTree* threshold) {
  return TreeMaker<Space>(space, parts_of_trees(order, std::move(graph), trees), trees).make(order.mesh(), threshold);
}

/// `make(order, trees, threshold)` makes trees as trees_of does.
template <class Make>
std::vector<MergeTree> find_trees(const VertexOrder& order, std::vector<Tree> trees, const MergeTreeOptions& options,
                                  Computed* computed, const Make& make) {
  const auto threshold = threshold_of(options, order.mesh().exchange().ranks());
  const bool simplifies = threshold && trees.back() == Tree::contour;
  if (simplifies) trees.pop_back();
  std::vector<MergeTree> found;
  if (!trees.empty()) found = make(order, trees, threshold ? &*threshold : nullptr);
  if (simplifies) {
    const SimplifiedField field = simplify_field(order, options.value, options.threshold, options, computed);
    const VertexOrder simplified = VertexOrder::of_places(order.mesh(), field.rank);
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
    Computing computing(of.mesh(), options, &shared);
    const Ranks& ranks = of.mesh().exchange().ranks();
    if (ranks.size() == 1)
      return with_extremum_graph(computing, of, options, [&](const auto& space, auto graph, const auto&) {
        return trees_of(space, of, std::move(graph), some, threshold);
      });
    MirroredGraph graph;
    together(ranks, [&] {
      graph = with_extremum_graph(computing, of, options, [](const auto&, auto found, const auto&) {
        return MirroredGraph{MirroredGraphSide(std::move(found[below])), MirroredGraphSide(std::move(found[above]))};
      });
    });
    MergeTreeOptions left = options;
    if (threshold == nullptr) left.threshold = 0;
    return trees_on_ranks(of, std::move(graph), some, left);
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
  detail::require_whole_mesh("a merge tree by kernels", order.mesh());
  return detail::as_array(detail::find_trees(
      order, detail::all_trees, options, nullptr,
      [&](const VertexOrder& of, const std::vector<Tree>& trees, const detail::ThresholdOfTree* threshold) {
        return detail::trees_of(space, of, detail::extremum_graph(space, of, sweep), trees, threshold);
      }));
}

}  // namespace gale
