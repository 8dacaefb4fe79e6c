#pragma once

#include <memory>

#include <gale/distributed/sharing/local_corners.hpp>

namespace gale::detail {

Segmentation octree_of(const HostPoints& points, int capacity);

/// The segments of the vertices that a rank owns, then those of its ghosts, by local input ids. From segmentations by
/// places among the owned ones, and among the ghosts.
Segmentation local_segmentation(const LocalVertices& vertices, const Segmentation& owned, const Segmentation& ghosts);

/// The mesh of triangles or tetrahedra, as rows have three or four vertices.
template <class Rows>
Mesh mesh_of_rows(const Rows& cells, const Segmentation& segmentation,
                  const std::shared_ptr<const Exchange>& exchange) {
  using Index = typename Rows::non_const_value_type;
  using Memory = typename Rows::memory_space;
  if (cells.extent(1) == 3)
    return Mesh(Triangles<Index, Memory>(cells.data(), cells.extent(0)), segmentation, exchange);
  return Mesh(Tetrahedra<Index, Memory>(cells.data(), cells.extent(0)), segmentation, exchange);
}

/// The mesh of what a rank holds, whose cells are written where the mesh is made: from their `rows` where a device has
/// them (see ReadCells). Errors name the global ids of cells.
template <class Index>
Mesh local_mesh(const LocalCells<Index>& cells, const LocalVertices& vertices, Array<const Quad, WorkerMemory> rows,
                const Segmentation& segmentation, const std::shared_ptr<const Exchange>& exchange);

}  // namespace gale::detail
