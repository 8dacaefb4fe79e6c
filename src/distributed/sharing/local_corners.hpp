#pragma once

#include <gale/distributed/sharing/local_cells.hpp>
#include <gale/distributed/sharing/local_vertices.hpp>

namespace gale::detail {

/// The vertices of each cell, a row each, by local input ids.
template <class Memory>
using CornersIn = Kokkos::View<Id**, Kokkos::LayoutRight, Memory>;

/// The local input ids of the cells' vertices, in the memory of `space`. Takes `rows`, of the cells' part, where a
/// device has them (see ReadCells).
template <class Space, class Index>
CornersIn<MemoryOf<Space>> corners_in(const Space& space, const LocalCells<Index>& cells, const LocalVertices& vertices,
                                      Array<const Quad, WorkerMemory> rows);

/// Writes them on the host, from the part's cells.
template <class Index>
CellRows<Id> local_corners(const LocalCells<Index>& cells, const LocalVertices& vertices);

/// Writes them from the rows of a part's cells, which keep their order (CellPlaces), and waits for that.
template <class Space, class Index>
CornersIn<MemoryOf<Space>> corners_of_rows(const Space& space, const LocalCells<Index>& cells,
                                           const LocalVertices& vertices,
                                           const Array<const Quad, MemoryOf<Space>>& rows);

}  // namespace gale::detail
