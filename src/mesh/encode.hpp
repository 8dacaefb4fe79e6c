#pragma once

#include <gale/base/csr.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/mesh.hpp>

// The steps that encode a mesh, in either space, and in its memory. Each is enqueued on the instance of a device, as
// loops are.

namespace gale::detail {

/// What the renumbering of a mesh's tetrahedra yields.
template <class Memory>
struct SortedTetrahedra {
  Csr<Quad, Memory, Id> of_lowest;  ///< by their lowest vertices; ascending in each, and from each to the next
  Array<Id, Memory> input;          ///< GALE's tetrahedron -> input tetrahedron
};

/// Renumbers and sorts (see Mesh). `vertex_internal` maps input vertices to GALE's.
template <class Space, class Index>
SortedTetrahedra<MemoryOf<Space>> sort_tetrahedra(const Space& space, const Tetrahedra<Index, MemoryOf<Space>>& input,
                                                  const Array<Id, MemoryOf<Space>>& vertex_internal);

/// Finds T_ex (see EncodedMesh), by segment, of a mesh of so many vertices, which has everything else.
template <class Space>
Csr<Id, MemoryOf<Space>> find_external_tetrahedra(const Space& space, const EncodedMesh<MemoryOf<Space>>& mesh,
                                                  Id vertices);

}  // namespace gale::detail
