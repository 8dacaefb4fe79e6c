#pragma once

#include <limits>
#include <type_traits>

#include <gale/mesh/encode.hpp>

// What both ways to encode a mesh read tetrahedra through.

namespace gale::detail {

KOKKOS_INLINE_FUNCTION void put_in_order(Id& a, Id& b) {
  const Id low = a < b ? a : b;
  b = a < b ? b : a;
  a = low;
}

/// The input's tetrahedra in GALE's ids. Owns nothing.
template <class Index>
class Renumbered {
 public:
  template <class Memory>
  Renumbered(const Tetrahedra<Index, Memory>& input, const Array<Id, Memory>& vertex_internal)
      : input_(input.data()), internal_(vertex_internal.data()), vertices_(vertex_internal.extent(0)) {}

  KOKKOS_FUNCTION Quad operator[](Offset t) const {
    const Index* const vertices = input_ + 4 * t;
    Quad quad{internal_[vertices[0]], internal_[vertices[1]], internal_[vertices[2]], internal_[vertices[3]]};
    put_in_order(quad.a, quad.b);
    put_in_order(quad.c, quad.d);
    put_in_order(quad.a, quad.c);
    put_in_order(quad.b, quad.d);
    put_in_order(quad.b, quad.c);
    return quad;
  }

  /// The lowest vertex of a tetrahedron; no_id if one of its vertices isn't there.
  KOKKOS_FUNCTION Id lowest(Offset t) const {
    Id lowest = above_all;
    for (int corner = 0; corner < 4; ++corner) {
      const auto vertex = static_cast<std::make_unsigned_t<Index>>(input_[4 * t + corner]);
      if (vertex >= vertices_) return no_id;
      const Id here = internal_[vertex];
      lowest = here < lowest ? here : lowest;
    }
    return lowest;
  }

 private:
  static constexpr Id above_all = std::numeric_limits<Id>::max();

  const Index* input_;
  const Id* internal_;
  std::make_unsigned_t<Index> vertices_;
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

/// The segments that a tetrahedron touches beside the one it is internal to. Its vertices ascend, and so do their
/// segments. Owns nothing.
struct ExternalSegments {
  const Quad* tetrahedra;
  SegmentOfVertex segment_of;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    const Quad quad = tetrahedra[t];
    Id previous = segment_of(quad.a);
    if (quad.d < segment_of.vertex_begin[previous + 1]) return;
    for (const Id vertex : {quad.b, quad.c, quad.d}) {
      const Id here = segment_of(vertex);
      if (here != previous) visit(here);
      previous = here;
    }
  }
};

/// Whether each of some sorted tetrahedra has four vertices, and no two have the same.
KOKKOS_INLINE_FUNCTION bool are_good(const Quad* sorted, Id begin, Id end) {
  bool good = true;
  for (Id t = begin; t < end; ++t) {
    const Quad here = sorted[t];
    good &= here.a < here.b && here.b < here.c && here.c < here.d && !(t > begin && sorted[t - 1] == here);
  }
  return good;
}

/// Throws gale::Error, naming the tetrahedra at fault, since some aren't good. `sorted` has those of the input if they
/// have vertices of the mesh alone.
template <class Space, class Index>
[[noreturn]] void refuse_tetrahedra(const Space& space, const Tetrahedra<Index, MemoryOf<Space>>& input,
                                    const SortedTetrahedra<MemoryOf<Space>>& sorted, Offset vertices);

}  // namespace gale::detail
