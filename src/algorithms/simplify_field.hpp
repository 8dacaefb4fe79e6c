#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/runtime/computation.hpp>

namespace gale {

/// A field without some of the extrema of another one: an order of the same vertices, and values that agree with it.
struct SimplifiedField {
  /// The place of each vertex in the new order, from 0, by input id: what a point array NAME_Order has.
  std::vector<Id> rank;

  /// The vertex whose value each vertex has now, by input id: itself, or the saddle up (down) to which its branch was
  /// filled. With these values the new order never falls.
  std::vector<Id> value_of;

  /// On one rank's part of several what `value_of` names: a mesh without cells that has these vertices, with their
  /// global ids, as other ranks may hold them. Empty where they are the mesh's own.
  std::optional<Mesh> excerpt{};

  Id minima = 0;  ///< how many minima are left
  Id maxima = 0;  ///< how many maxima are left

  /// How many of them should have gone, but could not: where a part of the mesh hangs on the rest by one vertex, it has
  /// an extremum in any order. 0 on a mesh whose vertices' stars are balls or half balls.
  Id kept_below = 0;
};

/// The extrema that are to stay, as input vertices in any order.
struct StayingExtrema {
  std::vector<Id> minima;  ///< minima of the field
  std::vector<Id> maxima;  ///< maxima of the field
};

/// Removes the minima and maxima whose persistence is below `threshold`: those of the join and of the split tree, each
/// paired with a saddle by the elder rule (`find_merge_tree`). The branch of a minimum is filled up to its saddle: its
/// vertices take the saddle's value, and come right after it in the order, each with one of them, or the saddle, before
/// it; maxima likewise, downwards. All else stays as it is. Minima and maxima in turns until none is left that should
/// go: filling up one branch may make another extremum less persistent, and flat parts may have extrema in their order.
/// So to simplify the result again changes nothing, and its persistence diagram has pairs of the extrema that stay
/// alone: of minima none below the threshold; of maxima there may be some, as the outside of the mesh, which no branch
/// ends in, takes their part where they come to the boundary (compare Lukasczyk, Garth, Maciejewski and Tierny,
/// "Localized Topological Simplification of Scalar Data", 2020).
///
/// `value(v)` is the field at an input vertex. One sweep of VV and link (of a grid that computes, of its keys alone),
/// and these rows of what changes once more; branches in parallel. Memory beside the result: 40 bytes a vertex, and 80
/// for each that changes. The result is the same whatever the structure, its segments, and the number of threads.
///
/// On one rank's part of several it is collective: the mesh is gathered and simplified on the first one, and each gets
/// what it holds. Some 16 bytes are gathered a vertex and 24 a cell, of a grid with all its cubes 16 a vertex alone;
/// SentMessages::gathered counts them. Throws gale::Error on all ranks, before anything is sent, if that is more than
/// the first rank's share of what its machine has left.
///
/// By kernels where the mesh is on a device and they find room there, else by threads of the host: `options` may say
/// otherwise, and `computed` is told; but the few vertices where paths meet are joined, and branches are filled, on the
/// host. Throws gale::Error for a threshold that isn't 0 or more, or no `value`; if a value that is asked for is NaN
/// (on ranks any that a rank holds), naming the vertex; and as make_structure and sweeps do.
GALE_EXPORT SimplifiedField simplify_field(const VertexOrder& order, const std::function<double(Id)>& value,
                                           double threshold, const ComputeOptions& options = {},
                                           Computed* computed = nullptr);

/// Removes all minima and maxima but these, likewise; on several ranks each names some that it holds. Throws
/// gale::Error for a vertex that isn't one of the mesh or no such extremum of the field, and where a component of the
/// mesh would have no minimum or no maximum.
GALE_EXPORT SimplifiedField simplify_field(const VertexOrder& order, const StayingExtrema& staying,
                                           const ComputeOptions& options = {}, Computed* computed = nullptr);

}  // namespace gale
