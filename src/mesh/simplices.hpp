#pragma once

#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/encoded_mesh.hpp>

namespace gale {

namespace detail {

/// Place of `value` among values[begin] to values[end - 1], which ascend; no_id if it isn't there. A few entries are
/// looked through, more are bisected first.
template <class Values>
KOKKOS_INLINE_FUNCTION Id find_in(const Values& values, Id begin, Id end, Id value) {
  constexpr Id few = 8;
  while (end - begin > few) {
    const Id middle = begin + (end - begin) / 2;
    if (values(middle) <= value) {
      begin = middle;
    } else {
      end = middle;
    }
  }
  for (; begin < end; ++begin) {
    const Id here = values(begin);
    if (here >= value) return here == value ? begin : no_id;
  }
  return no_id;
}

}  // namespace detail

/// Which simplices are numbered. Triangles need the edges.
enum class Enumeration { cells, edges, triangles };

/// What someone needs of the tables of `Simplices`.
struct SimplexNeeds {
  Enumeration upto = Enumeration::cells;  ///< what is numbered
  bool lower_edges = false;               ///< the edges by their higher vertex too; needs edges
  bool cells = false;                     ///< the cells themselves; on a device that has them they always come along
  bool edge_low = true;                   ///< that table, if edges are numbered
  bool triangle_edge = true;              ///< that table, if triangles are numbered; made when someone needs it first
};

/// All simplices of a mesh, each with its vertices ascending (a < b < c < d) and all of a dimension in lexicographic
/// order: that is their numbering. So the edges (a, .), the triangles (a, b, .) and the tetrahedra (a, ., ., .) are
/// contiguous, and a simplex is found by its vertices in a few steps. Tables that were not asked for are empty.
///
/// Owns nothing; may be copied into kernels. All ids are GALE's.
template <class Memory>
struct Simplices {
  /// An array that this doesn't own.
  template <class T>
  using Unmanaged = detail::Borrowed<T, Memory>;

  IdsByFour<Memory> cells;   ///< the vertices of each, see EncodedMesh
  int dimension = 3;         ///< the cells' dimension: 2 where they are triangles
  Unmanaged<Id> cell_begin;  ///< vertex a -> the first tetrahedron (a, ., ., .); one more at the end, as in all
                             ///< that follow

  Unmanaged<Id> edge_begin;  ///< vertex a -> the first edge (a, .)
  Unmanaged<Id> edge_low;    ///< edge (a, b) -> a
  Unmanaged<Id> edge_high;   ///< edge (a, b) -> b

  Unmanaged<Id> triangle_begin;  ///< edge (a, b) -> the first triangle (a, b, .)
  Unmanaged<Id> triangle_edge;   ///< triangle (a, b, c) -> the edge (a, b)
  Unmanaged<Id> triangle_apex;   ///< triangle (a, b, c) -> c

  Unmanaged<Id> lower_begin;  ///< vertex b -> where its edges (., b) begin in lower_edges
  Unmanaged<Id> lower_edges;  ///< the edges by their higher vertex, ascending
  Id longest_list = 0;  ///< known with lower_edges: the most edges (a, .), edges (., a) or tetrahedra (a, ., ., .)
                        ///< that a vertex a has

  /// The vertices of a cell, in one load.
  KOKKOS_FUNCTION Quad cell(Id t) const { return quad_at(cells.data(), t); }

  /// The edge (a, b), a < b; no_id if there is none.
  KOKKOS_FUNCTION Id edge_of(Id a, Id b) const {
    return detail::find_in(edge_high, edge_begin(a), edge_begin(a + 1), b);
  }

  /// The triangle (a, b, c) over the edge (a, b), b < c; no_id if there is none.
  KOKKOS_FUNCTION Id triangle_of(Id edge, Id c) const {
    return detail::find_in(triangle_apex, triangle_begin(edge), triangle_begin(edge + 1), c);
  }

  /// The triangle (a, b, c), a < b < c; no_id if there is none.
  KOKKOS_FUNCTION Id triangle_of(Id a, Id b, Id c) const {
    const Id edge = edge_of(a, b);
    return edge == no_id ? no_id : triangle_of(edge, c);
  }
};

}  // namespace gale
