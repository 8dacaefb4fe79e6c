#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/side_keys.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// The arcs of contour trees, in the order in which they are pruned from leaves.
struct ContourArcs {
  std::vector<std::pair<Id, Id>> ends;  ///< the lower node and the upper one

  /// By side, of the arc from each node to its parent: the contour arc whose pruning took it away. A vertex lies on the
  /// first one that took away its arc of either side.
  std::array<std::vector<Id>, 2> taken_by;

  static constexpr Id nobody = std::numeric_limits<Id>::max();
};

/// Combines join and split trees of the same nodes, numbered as they come in the order, given by the parents in each
/// (Carr, Snoeyink and Axen 2003). O(n).
ContourArcs contour_arcs(const std::array<std::vector<Id>, 2>& parents);

/// A tree without the arcs of vertices, of nodes (GALE's vertices, as they come in the order) and of arcs between them,
/// a lower and an upper one each. `place` is told where each of the arcs has gone.
MergeTree tree_of(const Mesh& mesh, const std::vector<Id>& nodes, const std::vector<std::pair<Id, Id>>& ends,
                  std::vector<Id>& place);

/// How many of so many vertices each arc has; arc_of(i) is that of the i-th, or no_id.
template <class ArcOf>
std::vector<Id> sizes_of(std::size_t arcs, Offset vertices, const ArcOf& arc_of) {
  auto sizes = of_parts("GALE::count_on_arcs", vertices, [&](Offset begin, Offset end) {
    std::vector<Id> mine(arcs, 0);
    Id last = no_id, run = 0;  // neighbours are mostly on one arc: to add one by one would wait for what was added
    const auto add_run = [&] {
      if (last != no_id) mine[last] += run;
    };
    for (Offset i = begin; i < end; ++i, ++run) {
      const Id arc = arc_of(i);
      if (arc == last) continue;
      add_run();
      last = arc;
      run = 0;
    }
    add_run();
    return mine;
  });
  parallel_for("GALE::add_on_arcs", HostExecutionSpace(), static_cast<Offset>(arcs), [&](Offset arc) {
    for (std::size_t part = 1; part < sizes.size(); ++part) sizes[0][arc] += sizes[part][arc];
  });
  return std::move(sizes[0]);
}

/// Gives a tree the arcs of its vertices: those of nodes may be any, and are set here. Counts the vertices on each.
void set_arcs(MergeTree& tree, std::vector<Id> arc_of);

}  // namespace gale::detail
