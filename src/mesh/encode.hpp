#pragma once

#include <gale/base/csr.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/mesh.hpp>

// How a mesh's cells are encoded: by a device, or by the host's threads. Both give the same. What a device does
// runs in either space, enqueued on its instance, as loops are.

namespace gale::detail {

/// What the renumbering of a mesh's cells yields.
template <class Memory>
struct SortedCells {
  Csr<Quad, Memory, Id> of_lowest;  ///< by their lowest vertices; ascending in each, and from each to the next
  Array<Id, Memory> input;          ///< GALE's cell -> input cell
};

/// Renumbers and sorts (see Mesh) as a device does: groups them by their lowest vertices, and each thread sorts those
/// of a vertex. `vertex_internal` maps input vertices to GALE's.
template <int corners, class Space, class Index>
SortedCells<MemoryOf<Space>> sort_cells_by_vertices(const Space& space,
                                                    const CellCorners<corners, Index, MemoryOf<Space>>& input,
                                                    const Array<Id, MemoryOf<Space>>& vertex_internal);

/// Finds T_ex (see EncodedMesh), by segment, as a device does. Segments begin at `vertex_begin`.
template <class Space>
Csr<Id, MemoryOf<Space>> find_external_cells(const Space& space, const Csr<Quad, MemoryOf<Space>, Id>& cells_of_lowest,
                                             const Borrowed<Id, MemoryOf<Space>>& vertex_begin);

/// What the host finds at once.
struct EncodedCells {
  SortedCells<HostMemory> sorted;
  Csr<Id, HostMemory> external;  ///< T_ex, by segment
};

/// Does both as the host does: threads deal the cells to groups of consecutive lowest vertices, each its part of
/// the input, and then sort group by group and count T_ex meanwhile. So little is read or written in no order.
template <int corners, class Index>
EncodedCells encode_by_groups(const CellCorners<corners, Index, HostMemory>& input,
                              const Array<Id, HostMemory>& vertex_internal,
                              const Borrowed<Id, HostMemory>& vertex_begin);

}  // namespace gale::detail
