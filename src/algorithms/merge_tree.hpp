#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/runtime/computation.hpp>

namespace gale {

/// What a tree follows while the order of the vertices is gone through.
enum class Tree {
  join,    ///< components of what is below: begins at minima
  split,   ///< components of what is above: begins at maxima
  contour  ///< components of level sets: both
};

/// An arc of a tree, between two of its nodes.
struct MergeArc {
  Id lower;  ///< the node at its lower end
  Id upper;  ///< the node at its upper end
  Id size;   ///< how many vertices lie on it, without its ends

  /// Compares both ends and the size.
  friend bool operator==(const MergeArc& a, const MergeArc& b) {
    return a.lower == b.lower && a.upper == b.upper && a.size == b.size;
  }
};

/// A join, split or contour tree; one for each of the mesh's components, all in the same arrays.
struct MergeTree {
  /// The nodes' input vertices, in the order of the field: lower nodes come before higher ones.
  std::vector<Id> vertices;

  /// What each node is by the numbers of arcs that it has below and above: 0 and 1 a minimum, 1 and 0 a maximum, 2 and
  /// 1 a 1-saddle, 1 and 2 a 2-saddle, anything else degenerate.
  std::vector<CriticalType> types;

  /// The arcs, by their lower nodes, then by their upper ones.
  std::vector<MergeArc> arcs;

  /// The arc of each vertex, by input id. A node belongs to the last of its arcs; no_id where it has none, which is a
  /// component of one vertex.
  std::vector<Id> arc_of;

  /// On one rank's part of several what `vertices` are named in: a mesh without cells that has these and a few others,
  /// with their global ids. Empty where they are the mesh's own.
  std::optional<Mesh> excerpt{};
};

/// How to find a tree.
struct MergeTreeOptions : ComputeOptions {
  /// Leaves out branches that are less persistent: what their vertices belong to is said at find_merge_tree.
  double threshold = 0;

  /// The field at an input vertex; needed where `threshold` isn't 0.
  std::function<double(Id)> value;
};

/// Finds the join, split or contour tree of the mesh that `order` orders.
///
/// *Join tree*: its nodes are minima, vertices where components of what is below meet, and the highest vertex of each
/// component of the mesh. An arc stands for such a component while it grows from one node to the next, and has the
/// vertices by which it grows. *Split tree*: the same of the reversed order. *Contour tree* (Carr, Snoeyink and Axen
/// 2003): both in one; its nodes are theirs. Where several components meet in one vertex, that is one node. On a mesh
/// that isn't simply connected the contour tree has no loops, either: it says of level sets what the two others know,
/// and a vertex may have been put on another arc as well.
///
/// From the components of each vertex's lower and upper neighbours: their steepest paths are followed to extrema, and
/// the few vertices where several paths meet are joined from the lowest to the highest (extremum graphs: Lukasczyk et
/// al. 2023). One sweep of VV and link; memory beside the result: 8 bytes a vertex and some 100 for each saddle. The
/// result is the same whatever the structure, its segments, and the number of threads.
///
/// With a `threshold`, join and split trees are without the extrema whose persistence (elder rule) is below it: a
/// branch that ends with one merges into the arc that it hangs on. A contour tree is that of the simplified field
/// (`simplify_field`).
///
/// On one rank's part of several it is collective: extrema, and vertices where the paths of several meet, as far as
/// they join what the rank's others don't, are gathered on all ranks, which make the same tree of them; the arcs of
/// vertices are those of all that the rank holds. Contour trees with a threshold gather the mesh, as simplify_field.
///
/// By kernels where the mesh is on a device and they find room there, else by threads of the host: `options` may say
/// otherwise, and `computed` is told; but what joins the few vertices where paths meet is on the host, and their keys
/// come there. Of a grid that computes the keys are all that is read. Throws gale::Error for a threshold that
/// isn't 0 or more, or one without values; naming the vertex, if a value is NaN where it is asked for; and as
/// require_consumers, make_structure and sweeps do.
GALE_EXPORT MergeTree find_merge_tree(const VertexOrder& order, Tree tree, const MergeTreeOptions& options = {},
                                      Computed* computed = nullptr);

/// Finds all three, by `Tree`, in one sweep; with a threshold simplify_field's work and another sweep come on top.
GALE_EXPORT std::array<MergeTree, 3> find_merge_trees(const VertexOrder& order, const MergeTreeOptions& options = {},
                                                      Computed* computed = nullptr);

/// Finds them by kernels where the relations are made; of `options` the threshold and the values count. Vertices of
/// more than 64 neighbours are visited on the host. What is said of sweeps (device_sweep.hpp) holds.
GALE_EXPORT std::array<MergeTree, 3> find_merge_trees(const WorkerSpace& space, const VertexOrder& order,
                                                      const MergeTreeOptions& options = {},
                                                      const DeviceSweepOptions& sweep = {});

/// What the sweep reads.
inline constexpr RelationSet merge_tree_relations = Relation::VV | link_form;

}  // namespace gale
