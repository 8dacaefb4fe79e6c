#include <algorithm>

#include <gale/algorithms/merge_tree/contour_arcs.hpp>
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
  const auto is_leaf = [&](Id node) { return children[below][node] + children[above][node] == 1; };
  std::vector<Id> leaves;
  std::vector<bool> is_gone(count, false);
  for (Id node = 0; node < count; ++node) {
    if (is_leaf(node)) leaves.push_back(node);
  }
  for (std::size_t next = 0; next < leaves.size(); ++next) {
    stop_if_asked_at(static_cast<std::int64_t>(next));
    const Id leaf = leaves[next];
    if (!is_leaf(leaf)) continue;  // the last of its tree
    const Side side = children[above][leaf] == 0 ? above : below;
    const auto arc = static_cast<Id>(arcs.ends.size());
    Id at = leaf;
    do {  // nodes that are gone lie on the arc that others have become
      arcs.taken_by[side][at] = arc;
      at = parents[side][at];
    } while (is_gone[at]);
    arcs.ends.emplace_back(std::min(leaf, at), std::max(leaf, at));
    is_gone[leaf] = true;
    --children[side][at];
    if (is_leaf(at)) leaves.push_back(at);
  }
  return arcs;
}

}  // namespace gale::detail
