#pragma once

#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// What the renumbering of a mesh' tetrahedra yields, in the workers' memory.
struct SortedTetrahedra {
  Kokkos::View<Id* [4], Kokkos::LayoutRight, WorkerMemory> vertices;  ///< ascending in each, and from each to the next
  Array<Id, WorkerMemory> input;                                      ///< GALE's tetrahedron -> input tetrahedron
  Array<Id, WorkerMemory> begin;  ///< vertex -> the first tetrahedron whose lowest vertex it is; one more at the end
};

/// Renumbers and sorts (see Mesh). `vertex_internal` maps input vertices to GALE's.
template <class Index>
SortedTetrahedra sort_tetrahedra(const Tetrahedra<Index, WorkerMemory>& input,
                                 const Array<Id, WorkerMemory>& vertex_internal);

/// T_ex (see EncodedMesh): fills external_begin and external of a mesh of so many vertices that has everything else.
void find_external_tetrahedra(MeshArrays<WorkerMemory>& mesh, Id vertices);

}  // namespace gale::detail
