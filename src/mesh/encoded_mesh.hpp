#pragma once

#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// The vertices of a cell, ascending unless it says otherwise: four of a tetrahedron, three of a triangle, which has
/// its third one at d again.
struct alignas(16) Quad {
  Id a;  ///< the vertex at corner 0
  Id b;  ///< the vertex at corner 1
  Id c;  ///< the vertex at corner 2
  Id d;  ///< the vertex at corner 3

  /// The vertex at a corner 0 to 3. Selects, so that it stays in registers where the corner isn't known at compile
  /// time.
  KOKKOS_FORCEINLINE_FUNCTION Id operator[](int corner) const {
    return corner == 0 ? a : corner == 1 ? b : corner == 2 ? c : d;
  }
};

/// Compares corner by corner.
KOKKOS_FORCEINLINE_FUNCTION bool operator==(const Quad& one, const Quad& other) {
  return one.a == other.a && one.b == other.b && one.c == other.c && one.d == other.d;
}

/// Compares in lexicographic order.
KOKKOS_FORCEINLINE_FUNCTION bool operator<(const Quad& one, const Quad& other) {
  if (one.a != other.a) return one.a < other.a;
  if (one.b != other.b) return one.b < other.b;
  if (one.c != other.c) return one.c < other.c;
  return one.d < other.d;
}

/// The t-th of four ids each, in one load. `vertices` is aligned to 16 bytes, as the memory of Views is, and nothing
/// writes it while a kernel runs.
KOKKOS_FORCEINLINE_FUNCTION Quad quad_at(const Id* vertices, Id t) {
  return detail::load_four(reinterpret_cast<const Quad*>(vertices) + t);
}

/// Four ids each, e.g. the vertices of tetrahedra, by row and column. Owns nothing.
template <class Memory>
using IdsByFour = Kokkos::View<const Id* [4], Kokkos::LayoutRight, Memory, Kokkos::MemoryUnmanaged>;

namespace detail {

/// An array that someone else owns, which other threads may copy at the same time: a managed View's count is no atomic
/// where Kokkos has Serial alone.
template <class T, class Memory>
using Borrowed = Kokkos::View<const T*, Memory, Kokkos::MemoryUnmanaged>;

}  // namespace detail

/// The arrays of a mesh that relations are computed from, where code that runs on `Memory` can read them. All ids are
/// GALE's own: vertices numbered segment after segment, cells sorted by their ascending vertices.
///
/// Owns nothing, so that threads and kernels may copy it (a managed View's count is no atomic where Kokkos has Serial
/// alone): a `Mesh` keeps the arrays.
template <class Memory>
struct EncodedMesh {
  /// An array that this doesn't own.
  template <class T>
  using Unmanaged = detail::Borrowed<T, Memory>;

  IdsByFour<Memory> cells;  ///< the vertices of each, ascending; of triangles the third one twice

  Unmanaged<Id> vertex_begin;        ///< I_V: segment s holds the vertices [vertex_begin[s], vertex_begin[s+1])
  Unmanaged<Id> internal_begin;      ///< I_T: its internal cells, whose lowest vertex it holds, likewise
  Unmanaged<Offset> external_begin;  ///< its row of `external`
  Unmanaged<Id> external;  ///< T_ex: the cells that touch it and are internal to an earlier segment, ascending in a row
  int dimension = 3;       ///< the cells' dimension: 3 where they are tetrahedra, 2 where they are triangles

  /// The vertices of a cell, in one load.
  KOKKOS_FORCEINLINE_FUNCTION Quad cell(Id t) const { return quad_at(cells.data(), t); }
};

namespace detail {

template <class Memory>
IdsByFour<Memory> by_four(const Array<const Quad, Memory>& quads) {
  return IdsByFour<Memory>(reinterpret_cast<const Id*>(quads.data()), quads.extent(0));
}

/// The arrays themselves, and vertex -> the first cell whose lowest vertex it is.
struct MeshArrays {
  Mirrored<Quad> cells;
  Mirrored<Id> vertex_begin, internal_begin;
  Mirrored<Offset> external_begin;
  Mirrored<Id> external;
  Mirrored<Id> cell_begin;
  int dimension = 3;

  /// Copies to `Memory` what isn't there.
  template <class Memory>
  EncodedMesh<Memory> in() const {
    return {by_four(cells.in<Memory>()), vertex_begin.in<Memory>(), internal_begin.in<Memory>(),
            external_begin.in<Memory>(), external.in<Memory>(),     dimension};
  }
};

}  // namespace detail

}  // namespace gale
