#pragma once

#include <gale/distributed/local_tetrahedra.hpp>
#include <gale/distributed/local_vertices.hpp>

namespace gale::detail {

/// The octree of the vertices that a rank owns, then that of its ghosts; by local input ids. Points are in the order of
/// `vertices`' owned ones, and of its ghosts.
Segmentation local_segmentation(const LocalVertices& vertices, const HostPoints& owned, const HostPoints& ghosts,
                                int capacity);

using Quads = Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>;

/// The local input ids of the tetrahedra's vertices.
template <class Index>
Quads local_corners(const LocalTetrahedra<Index>& tetrahedra, const LocalVertices& vertices);

/// The mesh of what a rank holds, whose tetrahedra are written where the mesh is made. Errors name the global ids of
/// tetrahedra.
template <class Index>
Mesh local_mesh(const LocalTetrahedra<Index>& tetrahedra, const LocalVertices& vertices,
                const Segmentation& segmentation);

}  // namespace gale::detail
