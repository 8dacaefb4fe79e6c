#include <algorithm>
#include <numeric>
#include <utility>

#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/base/error.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

ContourArcs contour_arcs(const std::array<std::vector<Id>, 2>& parents) {
  const auto count = static_cast<Id>(parents[below].size());
  ContourArcs arcs;
  // A node's arcs downwards are those from its children in the join tree; upwards, in the split tree.
  std::array<std::vector<Id>, 2> children;
  for (const Side side : {below, above}) {
    arcs.taken_by[side].assign(count, ContourArcs::nobody);
    children[side].assign(count, 0);
    for (const Id parent : parents[side]) {
      if (parent != no_id) ++children[side][parent];
    }
  }
  const auto is_leaf = [&](Id node) { return children[below][node] + children[above][node] <= 1; };
  std::vector<Id> leaves;
  std::vector<bool> is_gone(count, false);
  for (Id node = 0; node < count; ++node) {
    if (is_leaf(node)) leaves.push_back(node);
  }
  const auto next_left = [&](Side side, Id node) {
    do {
      node = parents[side][node];
    } while (node != no_id && is_gone[node]);
    return node;
  };
  struct Way {
    Side side;
    Id first, end, arc;
  };
  std::vector<Way> left_over;
  // Nodes that are gone lie on the arc that others have become.
  const auto take = [&](const Way& way) {
    for (Id at = way.first; at != way.end; at = parents[way.side][at]) arcs.taken_by[way.side][at] = way.arc;
  };
  const auto lose_child = [&](Side side, Id node) {
    --children[side][node];
    if (is_leaf(node)) leaves.push_back(node);
  };
  for (std::size_t next = 0; next < leaves.size(); ++next) {
    stop_if_asked_at(static_cast<std::int64_t>(next));
    const Id leaf = leaves[next];
    if (is_gone[leaf]) continue;
    const auto arc = static_cast<Id>(arcs.ends.size());
    Side side = children[above][leaf] == 0 ? above : below;
    Id at = next_left(side, leaf);
    if (children[below][leaf] == 0 && side == above) {  // the last of its tree; in a mesh with holes others, too
      Side other = below;
      Id beyond = next_left(other, leaf);
      if (at == no_id) {
        std::swap(side, other);
        std::swap(at, beyond);
      }
      if (at == no_id) continue;
      left_over.push_back({other, leaf, beyond, arc});
      if (beyond != no_id) lose_child(other, beyond);
    }
    take({side, leaf, at, arc});
    arcs.ends.emplace_back(std::min(leaf, at), std::max(leaf, at));
    is_gone[leaf] = true;
    lose_child(side, at);
  }
  if (!left_over.empty()) require_ids("arcs of a contour tree, counted twice", 2 * Offset(arcs.ends.size()));
  for (Way& way : left_over) {
    way.arc += static_cast<Id>(arcs.ends.size());
    take(way);
  }
  return arcs;
}

namespace {

CriticalType type_of_node(int lower_arcs, int upper_arcs) {
  if (lower_arcs == 0 && upper_arcs == 1) return CriticalType::minimum;
  if (lower_arcs == 1 && upper_arcs == 0) return CriticalType::maximum;
  if (lower_arcs == 2 && upper_arcs == 1) return CriticalType::saddle1;
  if (lower_arcs == 1 && upper_arcs == 2) return CriticalType::saddle2;
  return CriticalType::degenerate;
}

}  // namespace

MergeTree tree_of(std::vector<Id> nodes, const std::vector<std::pair<Id, Id>>& ends, std::vector<Id>& place) {
  MergeTree tree;
  std::vector<Id> sorted(ends.size());
  std::iota(sorted.begin(), sorted.end(), Id(0));
  parallel_sort("GALE::sort_arcs", sorted.begin(), sorted.end(), [&](Id a, Id b) { return ends[a] < ends[b]; });
  std::vector<int> lower_arcs(nodes.size(), 0), upper_arcs(nodes.size(), 0);
  place.resize(ends.size());
  for (const Id arc : sorted) {
    place[arc] = static_cast<Id>(tree.arcs.size());
    tree.arcs.push_back({ends[arc].first, ends[arc].second, 0});
    ++upper_arcs[ends[arc].first];
    ++lower_arcs[ends[arc].second];
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) tree.types.push_back(type_of_node(lower_arcs[i], upper_arcs[i]));
  tree.vertices = std::move(nodes);
  return tree;
}

void set_arcs_of_nodes(MergeTree& tree) {
  for (const Id vertex : tree.vertices) {
    const Id arc = std::exchange(tree.arc_of[vertex], no_id);
    if (arc != no_id) --tree.arcs[arc].size;
  }
  for (std::size_t i = 0; i < tree.arcs.size(); ++i) {
    for (const Id end : {tree.arcs[i].lower, tree.arcs[i].upper}) tree.arc_of[tree.vertices[end]] = static_cast<Id>(i);
  }
}

}  // namespace gale::detail
