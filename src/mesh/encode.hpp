#pragma once

#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/mesh.hpp>

// The steps that encode a mesh, in either space, and in its memory. Each is enqueued on the instance of a device, as
// loops are.

namespace gale::detail {

/// What the renumbering of a mesh's tetrahedra yields.
template <class Memory>
struct SortedTetrahedra {
  Array<Quad, Memory> vertices;  ///< ascending in each, and from each to the next
  Array<Id, Memory> input;       ///< GALE's tetrahedron -> input tetrahedron
  Array<Id, Memory> begin;       ///< vertex -> the first tetrahedron whose lowest vertex it is; one more at the end
};

/// Renumbers and sorts (see Mesh). `vertex_internal` maps input vertices to GALE's.
template <class Space, class Index>
SortedTetrahedra<MemoryOf<Space>> sort_tetrahedra(const Space& space, const Tetrahedra<Index, MemoryOf<Space>>& input,
                                                  const Array<Id, MemoryOf<Space>>& vertex_internal);

/// T_ex: see EncodedMesh.
template <class Memory>
struct ExternalTetrahedra {
  Array<Offset, Memory> begin;
  Array<Id, Memory> ids;
};

/// Finds T_ex of a mesh of so many vertices, which has everything else.
template <class Space>
ExternalTetrahedra<MemoryOf<Space>> find_external_tetrahedra(const Space& space,
                                                             const EncodedMesh<MemoryOf<Space>>& mesh, Id vertices);

}  // namespace gale::detail
