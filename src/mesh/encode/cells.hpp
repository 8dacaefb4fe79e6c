#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <gale/mesh/encode.hpp>

// What both ways to encode a mesh read cells through.

namespace gale::detail {

KOKKOS_INLINE_FUNCTION void put_in_order(Id& a, Id& b) {
  const Id low = a < b ? a : b;
  b = a < b ? b : a;
  a = low;
}

/// The input's cells in GALE's ids. Owns nothing.
template <int corners, class Index>
class Renumbered {
 public:
  template <class Memory>
  Renumbered(const CellCorners<corners, Index, Memory>& input, const Array<Id, Memory>& vertex_internal)
      : input_(input.data()),
        internal_(vertex_internal.data()),
        vertices_(vertex_internal.extent(0)),
        are_aligned_(corners == 4 && reinterpret_cast<std::uintptr_t>(input_) % alignof(Corners) == 0) {}

  KOKKOS_FUNCTION Quad operator[](Offset t) const {
    const Corners of = corners_of(t);
    Quad quad{internal_[of.vertices[0]], internal_[of.vertices[1]], internal_[of.vertices[2]],
              internal_[of.vertices[corners - 1]]};
    put_in_order(quad.a, quad.b);
    if constexpr (corners == 4) {
      put_in_order(quad.c, quad.d);
      put_in_order(quad.a, quad.c);
      put_in_order(quad.b, quad.d);
      put_in_order(quad.b, quad.c);
    } else {
      put_in_order(quad.b, quad.c);
      put_in_order(quad.a, quad.b);
      quad.d = quad.c;
    }
    return quad;
  }

  /// The lowest vertex of a cell; no_id if one of its vertices isn't there.
  KOKKOS_FUNCTION Id lowest(Offset t) const {
    const Corners of = corners_of(t);
    Id lowest = above_all;
    for (int corner = 0; corner < corners; ++corner) {
      const auto vertex = static_cast<std::make_unsigned_t<Index>>(of.vertices[corner]);
      if (vertex >= vertices_) return no_id;
      const Id here = internal_[vertex];
      lowest = here < lowest ? here : lowest;
    }
    return lowest;
  }

 private:
  static constexpr Id above_all = std::numeric_limits<Id>::max();

  struct alignas(corners == 4 ? 16 : alignof(Index)) Corners {
    Index vertices[corners];
  };

  /// A device loads 16 bytes at a time where it may: a caller's array can begin anywhere.
  KOKKOS_FORCEINLINE_FUNCTION Corners corners_of(Offset t) const {
    if (compiled_for_device() && are_aligned_) return reinterpret_cast<const Corners*>(input_)[t];
    Corners of;
    for (int corner = 0; corner < corners; ++corner) of.vertices[corner] = input_[corners * t + corner];
    return of;
  }

  const Index* input_;
  const Id* internal_;
  std::make_unsigned_t<Index> vertices_;
  bool are_aligned_;
};

/// The segment of each vertex: that of its block's first vertex, or one soon behind it. Takes a sixteenth of the memory
/// that an id for each vertex takes. Owns nothing.
struct SegmentOfVertex {
  static constexpr int block_bits = 4;

  const Id* of_block;
  const Id* vertex_begin;  ///< of segments

  KOKKOS_FUNCTION Id operator()(Id vertex) const {
    Id segment = of_block[vertex >> block_bits];
    while (vertex_begin[segment + 1] <= vertex) ++segment;
    return segment;
  }
};

/// The segment of each block's first vertex.
template <class Space>
Array<Id, MemoryOf<Space>> segments_of_blocks(const Space& space, const Borrowed<Id, MemoryOf<Space>>& vertex_begin,
                                              Offset vertices);

/// The segments that a cell touches beside the one it is internal to. Its vertices ascend, and so do their
/// segments. Owns nothing.
struct ExternalSegments {
  const Quad* cells;
  SegmentOfVertex segment_of;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    const Quad quad = cells[t];
    Id end = segment_of.vertex_begin[segment_of(quad.a) + 1];
    if (quad.d < end) return;
    for (int corner = 1; corner < 4; ++corner) {
      if (quad[corner] < end) continue;
      const Id segment = segment_of(quad[corner]);
      visit(segment);
      end = segment_of.vertex_begin[segment + 1];
    }
  }
};

/// Whether a cell, whose vertices ascend, has no vertex twice.
template <int corners>
KOKKOS_INLINE_FUNCTION bool has_different_vertices(const Quad& cell) {
  return cell.a < cell.b && cell.b < cell.c && (corners == 3 || cell.c < cell.d);
}

/// Whether each of some sorted cells has different vertices, and no two cells have the same.
template <int corners>
KOKKOS_INLINE_FUNCTION bool are_good(const Quad* sorted, Id begin, Id end) {
  bool good = true;
  for (Id t = begin; t < end; ++t) {
    good &= has_different_vertices<corners>(sorted[t]) && !(t > begin && sorted[t - 1] == sorted[t]);
  }
  return good;
}

/// Throws gale::Error, naming the cells at fault, since some aren't good. `sorted` has those of the input if they have
/// vertices of the mesh alone.
template <int corners, class Space, class Index>
[[noreturn]] void refuse_cells(const Space& space, const CellCorners<corners, Index, MemoryOf<Space>>& input,
                               const SortedCells<MemoryOf<Space>>& sorted, Offset vertices);

}  // namespace gale::detail
