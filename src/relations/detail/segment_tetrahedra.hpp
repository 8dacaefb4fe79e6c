#pragma once

#include <gale/mesh/encoded_mesh.hpp>

namespace gale::detail {

/// The tetrahedra that touch a segment, in ascending order: the external ones come first, since they are internal to earlier segments.
template <class Memory>
struct SegmentTetrahedra {
  const Id* external;
  Id externals;
  Id first_internal;
  Id count;

  KOKKOS_FUNCTION SegmentTetrahedra(const EncodedMesh<Memory>& mesh, Id segment)
      : external(mesh.external.data() + mesh.external_begin(segment)),
        externals(static_cast<Id>(mesh.external_begin(segment + 1) - mesh.external_begin(segment))),
        first_internal(mesh.tetrahedron_begin(segment)),
        count(externals + mesh.tetrahedron_begin(segment + 1) - first_internal) {}

  KOKKOS_FUNCTION Id operator[](Id i) const { return i < externals ? external[i] : first_internal + (i - externals); }
};

}  // namespace gale::detail
