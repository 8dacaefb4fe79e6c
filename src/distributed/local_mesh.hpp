#pragma once

#include <gale/distributed/local_tetrahedra.hpp>

namespace gale::detail {

/// The vertices that a rank holds, ascending: local input ids are places among them.
struct LocalVertices {
  GlobalIds ids;
  Array<std::uint8_t, HostMemory> is_owned;
};

/// Of the vertices that it owns, and of ghosts; both ascend.
LocalVertices local_vertices(const GlobalIds& owned, const GlobalIds& ghosts);

/// The local input ids of those that it doesn't own.
Array<Id, HostMemory> ghosts_of(const LocalVertices& vertices);

/// The octree of the owned vertices, then that of the ghosts. By local input ids.
Segmentation local_segmentation(const Points<double, HostMemory>& points,
                                const Array<std::uint8_t, HostMemory>& is_owned, int capacity);

using Quads = Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>;

/// The local input ids of the tetrahedra's vertices, which are places among `vertices`; those of `own` follow one
/// another there.
template <class Index>
Quads local_corners(const LocalTetrahedra<Index>& tetrahedra, const IdInterval& own, const GlobalIndex& vertices);

/// The mesh of what a rank holds. Errors name the global ids of tetrahedra.
Mesh local_mesh(const Tetrahedra<Id, HostMemory>& corners, const Array<const GlobalId, HostMemory>& ids,
                const Segmentation& segmentation);

}  // namespace gale::detail
