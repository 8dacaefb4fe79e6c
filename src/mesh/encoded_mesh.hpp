#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// The arrays of a mesh that relations are computed from, where code that runs on `Memory` can read them. All ids are
/// GALE's own: vertices numbered segment after segment, tetrahedra sorted by their four ascending vertices.
///
/// Owns nothing, so that threads and kernels may copy it (a managed View's count is no atomic where Kokkos has Serial
/// alone): a `Mesh` keeps the arrays.
template <class Memory>
struct EncodedMesh {
  template <class T>
  using Unmanaged = Kokkos::View<const T*, Memory, Kokkos::MemoryUnmanaged>;

  /// Four vertices each, ascending.
  Kokkos::View<const Id* [4], Kokkos::LayoutRight, Memory, Kokkos::MemoryUnmanaged> tetrahedra;

  Unmanaged<Id> vertex_begin;        ///< I_V: segment s holds the vertices [vertex_begin[s], vertex_begin[s+1])
  Unmanaged<Id> internal_begin;      ///< I_T: its internal tetrahedra, whose lowest vertex it holds, likewise
  Unmanaged<Offset> external_begin;  ///< its row of `external`
  Unmanaged<Id>
      external;  ///< T_ex: the tetrahedra that touch it and are internal to an earlier segment, ascending in a row
};

/// The arrays themselves.
template <class Memory>
struct MeshArrays {
  Kokkos::View<Id* [4], Kokkos::LayoutRight, Memory> tetrahedra;
  Array<Id, Memory> vertex_begin, internal_begin;
  Array<Offset, Memory> external_begin;
  Array<Id, Memory> external;

  EncodedMesh<Memory> view() const { return {tetrahedra, vertex_begin, internal_begin, external_begin, external}; }
};

}  // namespace gale
