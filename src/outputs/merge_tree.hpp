#pragma once

#include <array>
#include <string>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// The trees by the names that users say, in the order of `Tree`.
inline constexpr const char* tree_names[] = {"join", "split", "contour"};

/// The tree of that name. Throws gale::Error for any other.
GALE_EXPORT Tree tree_named(const std::string& name);

/// The nodes of a tree as points where their vertices are, in their order. Each has the input's point arrays at its
/// vertex, then NodeId (int32, from 0), Scalar (the field; float if that is, else double), VertexId (int32, the input
/// id), CriticalType (int8, the codes of `CriticalType`), and of the node's arc (`MergeTree::arc_of`) RegionSize and
/// RegionSpan, as `tree_segmentation` has them. On several ranks `dataset` and `field` are those of the tree's excerpt
/// (`dataset_of`), here and below, and VertexId is int64, the global id.
GALE_EXPORT io::PointSet tree_nodes(const io::Dataset& dataset, const io::PointArray& field, const MergeTree& tree);

/// A vertex on an arc, but none of its ends.
struct ArcVertex {
  GlobalId id;               ///< the vertex's own
  Id arc;                    ///< that it lies on, of the tree
  double value;              ///< the field there
  std::array<double, 3> at;  ///< its point
};

/// Gathers what `tree_arcs` samples of a tree that lies on several ranks: all vertices on its arcs, on the first one,
/// by ascending id, 48 bytes each. `mesh`, `dataset` and `field` are what the tree is of. Nothing on one rank, or where
/// there are no samples. Collective; throws gale::Error on all ranks, before anything is sent, if the first one hasn't
/// the memory.
GALE_EXPORT std::vector<ArcVertex> gather_arc_vertices(const Mesh& mesh, const io::Dataset& dataset,
                                                       const io::PointArray& field, const MergeTree& tree, int samples);

/// The arcs of a tree as lines, in their order: from the lower node, over at most `samples` points between, to the
/// upper one. The points between are the barycentres of the arc's vertices, by parts of equal height; empty parts have
/// none. The nodes' points come first, in their order.
///
/// Point arrays: Scalar (the field, of barycentres its mean; float if the field is, else double), RegularMask (int8: 0
/// at nodes, 1 between). Arrays of lines: SegmentationId (int32, from 0), upNodeId, downNodeId, RegionSize (int32),
/// RegionSpan.
///
/// On several ranks the points between are those of `gathered` (`gather_arc_vertices`).
GALE_EXPORT io::Surface tree_arcs(const io::Dataset& dataset, const io::PointArray& field, const MergeTree& tree,
                                  int samples = 0, const std::vector<ArcVertex>& gathered = {});

/// What each vertex of the mesh belongs to, as point arrays in input order: SegmentationId (int32, its arc; -1 if it
/// has none), RegionType (int8: 0 an arc that ends in a minimum, 1 in a maximum, 2 between 1-saddles, 3 between
/// 2-saddles, 4 any other; -1), RegionSize (int32, the arc's vertices but for its ends), RegionSpan (the distance of
/// its ends; float if the points are, else double).
GALE_EXPORT std::vector<io::PointArray> tree_segmentation(const io::Dataset& dataset, const MergeTree& tree);

}  // namespace gale::outputs
