#pragma once

#include <gale/mesh/encoded_mesh.hpp>

namespace gale::detail {

/// The tetrahedra that touch a segment, in ascending order: the external ones come first, since they are internal to
/// earlier segments.
template <class Memory>
struct SegmentTetrahedra {
  const Id* external;
  Id externals;
  Id first_internal;
  Id count;

  KOKKOS_FORCEINLINE_FUNCTION SegmentTetrahedra(const EncodedMesh<Memory>& mesh, Id segment)
      : external(mesh.external.data() + mesh.external_begin(segment)),
        externals(static_cast<Id>(mesh.external_begin(segment + 1) - mesh.external_begin(segment))),
        first_internal(mesh.internal_begin(segment)),
        count(externals + mesh.internal_begin(segment + 1) - first_internal) {}

  KOKKOS_FORCEINLINE_FUNCTION Id operator[](Id i) const {
    return i < externals ? external[i] : first_internal + (i - externals);
  }
};

/// A segment as the kernels of its stars see it.
template <class Memory>
struct StarSegment {
  SegmentTetrahedra<Memory> tetrahedra;
  Id first;  ///< vertex
  Id rows;

  KOKKOS_FORCEINLINE_FUNCTION StarSegment(const EncodedMesh<Memory>& mesh, Id segment)
      : tetrahedra(mesh, segment), first(mesh.vertex_begin(segment)), rows(mesh.vertex_begin(segment + 1) - first) {}

  /// The row of a vertex, in 0..rows-1 if the segment holds it.
  KOKKOS_FORCEINLINE_FUNCTION Id row_of(Id vertex) const { return vertex - first; }
  KOKKOS_FORCEINLINE_FUNCTION bool has(Id row) const {
    return static_cast<std::uint32_t>(row) < static_cast<std::uint32_t>(rows);
  }
};

}  // namespace gale::detail
