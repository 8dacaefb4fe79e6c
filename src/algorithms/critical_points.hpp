#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/runtime/computation.hpp>

namespace gale {

/// What a vertex is to a piecewise linear field, with TTK's codes.
enum class CriticalType : std::uint8_t {
  minimum = 0,
  saddle1 = 1,
  saddle2 = 2,
  maximum = 3,
  degenerate = 4,
  regular = 5
};

/// The vertices that aren't regular, by ascending input id; on one rank's part of a mesh those that it owns.
struct CriticalPoints {
  std::vector<Id> vertices;              ///< input ids
  std::vector<CriticalType> types;       ///< the type of each
  std::vector<std::uint8_t> on_surface;  ///< 1 if it belongs to a triangle with exactly one tetrahedron, or, on
                                         ///< triangle meshes, to an edge with exactly one triangle

  /// How many there are of each type but `regular`, on all ranks.
  std::array<GlobalId, 5> counts{};
};

/// Finds the critical points of a piecewise linear field (Banchoff 1970) by the numbers L and U of connected components
/// of the lower and of the upper neighbours of each vertex, joined along the tetrahedra of its star:
///
///     L, U    0, 1 minimum    2, 1 1-saddle    1, 2 2-saddle    1, 0 maximum    1, 1 regular    else degenerate
///
/// except that a vertex on the surface with L, U = 1, 1 is a 1-saddle if some upper neighbour is on the surface and no
/// lower one, and a 2-saddle if some lower one is and no upper one, as TTK has it. On triangle meshes neighbours are
/// joined along the triangles; L, U = 2, 1 and 1, 2 and 2, 2 are saddles (saddle1), 1, 1 is regular on the boundary
/// too.
///
/// By kernels where the mesh is on a device and they find room there, else by threads of the host: `options` may say
/// otherwise, and `computed` is told. The result is the same, and so it is for any number of ranks; collective where
/// the mesh is one rank's part. Throws gale::Error as require_consumers, make_structure and sweeps do.
GALE_EXPORT CriticalPoints find_critical_points(const VertexOrder& order, const ComputeOptions& options = {},
                                                Computed* computed = nullptr);

/// Finds them by threads of the host, in a sweep of VV and link, for which `structure` must be preconditioned; the same
/// result whatever the structure, its segments, and the number of threads. 2 bytes a vertex beside the result, and on
/// ranks one exchange of a byte a ghost. Throws gale::Error if it isn't preconditioned for them, and if `order` is of
/// another mesh than the structure's.
GALE_EXPORT CriticalPoints find_critical_points(Structure& structure, const VertexOrder& order,
                                                const SweepOptions& options = {});

/// Finds them by kernels where the relations are made: reads a mesh and an order that lie there and
/// brings nothing but the result to the host. Vertices of more than 64 neighbours are classified on the host: for them
/// alone, if there are any, the mesh and the keys come to it. 10 bytes a vertex beside the blocks. What is said of
/// sweeps (device_sweep.hpp) holds.
GALE_EXPORT CriticalPoints find_critical_points(const WorkerSpace& space, const VertexOrder& order,
                                                const DeviceSweepOptions& options = {});

/// What the sweep reads.
inline constexpr RelationSet critical_points_relations = Relation::VV | link_form;

}  // namespace gale
