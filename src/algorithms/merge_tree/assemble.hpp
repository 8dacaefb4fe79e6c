#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>

namespace gale::detail {

/// A tree without the arcs of vertices, of nodes (GALE's vertices, as they come in the order) and of arcs between them,
/// a lower and an upper one each. `place` is told where each of the arcs has gone.
MergeTree tree_of(const Mesh& mesh, const std::vector<Id>& nodes, const std::vector<std::pair<Id, Id>>& ends,
                  std::vector<Id>& place);

/// Gives a tree the arcs of its vertices: those of nodes may be any, and are set here. Counts the vertices on each.
void set_arcs(MergeTree& tree, std::vector<Id> arc_of);

}  // namespace gale::detail
