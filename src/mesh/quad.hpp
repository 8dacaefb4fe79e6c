#pragma once

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// The four vertices of a tetrahedron, ascending unless it says otherwise.
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
#if defined(GALE_ON_DEVICE)
  const int4 four = __ldg(reinterpret_cast<const int4*>(vertices) + t);
  return {four.x, four.y, four.z, four.w};
#else
  return reinterpret_cast<const Quad*>(vertices)[t];
#endif
}

}  // namespace gale
