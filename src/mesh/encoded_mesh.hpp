#pragma once

#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/quad.hpp>

namespace gale {

/// Four ids each, e.g. the vertices of tetrahedra, by row and column. Owns nothing.
template <class Memory>
using IdsByFour = Kokkos::View<const Id* [4], Kokkos::LayoutRight, Memory, Kokkos::MemoryUnmanaged>;

/// The arrays of a mesh that relations are computed from, where code that runs on `Memory` can read them. All ids are
/// GALE's own: vertices numbered segment after segment, tetrahedra sorted by their four ascending vertices.
///
/// Owns nothing, so that threads and kernels may copy it (a managed View's count is no atomic where Kokkos has Serial
/// alone): a `Mesh` keeps the arrays.
template <class Memory>
struct EncodedMesh {
  /// An array that this doesn't own.
  template <class T>
  using Unmanaged = Kokkos::View<const T*, Memory, Kokkos::MemoryUnmanaged>;

  IdsByFour<Memory> tetrahedra;  ///< four vertices each, ascending

  Unmanaged<Id> vertex_begin;        ///< I_V: segment s holds the vertices [vertex_begin[s], vertex_begin[s+1])
  Unmanaged<Id> internal_begin;      ///< I_T: its internal tetrahedra, whose lowest vertex it holds, likewise
  Unmanaged<Offset> external_begin;  ///< its row of `external`
  Unmanaged<Id>
      external;  ///< T_ex: the tetrahedra that touch it and are internal to an earlier segment, ascending in a row

  /// The four vertices of a tetrahedron, in one load.
  KOKKOS_FORCEINLINE_FUNCTION Quad tetrahedron(Id t) const { return quad_at(tetrahedra.data(), t); }
};

namespace detail {

template <class Memory>
IdsByFour<Memory> by_four(const Array<const Quad, Memory>& quads) {
  return IdsByFour<Memory>(reinterpret_cast<const Id*>(quads.data()), quads.extent(0));
}

/// The arrays themselves, and vertex -> the first tetrahedron whose lowest vertex it is.
struct MeshArrays {
  Mirrored<Quad> tetrahedra;
  Mirrored<Id> vertex_begin, internal_begin;
  Mirrored<Offset> external_begin;
  Mirrored<Id> external;
  Mirrored<Id> tetrahedron_begin;

  /// Copies to `Memory` what isn't there.
  template <class Memory>
  EncodedMesh<Memory> in() const {
    return {by_four(tetrahedra.in<Memory>()), vertex_begin.in<Memory>(), internal_begin.in<Memory>(),
            external_begin.in<Memory>(), external.in<Memory>()};
  }
};

}  // namespace detail

}  // namespace gale
