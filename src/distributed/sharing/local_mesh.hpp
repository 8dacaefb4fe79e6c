#pragma once

#include <memory>

#include <gale/distributed/sharing/local_tetrahedra.hpp>
#include <gale/distributed/sharing/local_vertices.hpp>

namespace gale::detail {

Segmentation octree_of(const HostPoints& points, int capacity);

/// The segments of the vertices that a rank owns, then those of its ghosts, by local input ids. From segmentations by
/// places among the owned ones, and among the ghosts.
Segmentation local_segmentation(const LocalVertices& vertices, const Segmentation& owned, const Segmentation& ghosts);

using Quads = Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>;

/// The local input ids of the tetrahedra's vertices.
template <class Index>
Quads local_corners(const LocalTetrahedra<Index>& tetrahedra, const LocalVertices& vertices);

/// The mesh of what a rank holds, whose tetrahedra are written where the mesh is made. Errors name the global ids of
/// tetrahedra.
template <class Index>
Mesh local_mesh(const LocalTetrahedra<Index>& tetrahedra, const LocalVertices& vertices,
                const Segmentation& segmentation, const std::shared_ptr<const Exchange>& exchange);

}  // namespace gale::detail
