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

/// The mesh of what a rank holds. Errors name global ids.
template <class Index>
Mesh local_mesh(const LocalTetrahedra<Index>& tetrahedra, const GlobalIndex& vertices,
                const Segmentation& segmentation);

}  // namespace gale::detail
