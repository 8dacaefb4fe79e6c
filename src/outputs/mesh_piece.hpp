#pragma once

#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>

namespace gale::outputs {

/// What one rank writes of a mesh that lies on several: the cells whose highest vertices it owns, with their
/// vertices and all others that it owns. Cells are in one piece each, vertices may be in several.
///
/// `dataset` has points, arrays and cells by input ids of the part, and `more` arrays beside its own; they come first.
/// Then vtkGhostType (uint8), which is 1 (a duplicate) for vertices of other ranks, GlobalPointIds and GlobalCellIds
/// (int64), the global ids of vertices and of tetrahedra or triangles, or of the cells that these are of, where
/// `dataset` has those. `has_ids`: the dataset brings GlobalPointIds of its own.
GALE_EXPORT io::Dataset piece_of(const VertexOrder& order, const io::Dataset& dataset,
                                 const std::vector<io::PointArray>& more, bool has_ids);

}  // namespace gale::outputs
