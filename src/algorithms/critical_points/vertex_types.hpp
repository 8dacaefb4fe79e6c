#pragma once

#include <cstdint>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// What a vertex of a triangle mesh is.
KOKKOS_INLINE_FUNCTION CriticalType type_on_triangles(const LinkTopology& topology) {
  const int lower = topology.lower, upper = topology.upper;
  if (lower == 0 || upper == 0) {
    return lower == 0 && upper == 1   ? CriticalType::minimum
           : lower == 1 && upper == 0 ? CriticalType::maximum
                                      : CriticalType::degenerate;
  }
  if (lower > 2 || upper > 2) return CriticalType::degenerate;
  return lower == 1 && upper == 1 ? CriticalType::regular : CriticalType::saddle1;
}

/// What a vertex among tetrahedra is by its own link.
KOKKOS_INLINE_FUNCTION CriticalType type_of(const LinkTopology& topology) {
  const int code = 16 * (topology.lower < 3 ? topology.lower : 3) + (topology.upper < 3 ? topology.upper : 3);
  switch (code) {
    case 0x01:
      return CriticalType::minimum;
    case 0x21:
      return CriticalType::saddle1;
    case 0x12:
      return CriticalType::saddle2;
    case 0x10:
      return CriticalType::maximum;
    case 0x11:
      return CriticalType::regular;
    default:
      return CriticalType::degenerate;
  }
}

/// The type of each vertex, while a sweep finds it by the vertex's own link. Vertices on the surface tell their
/// neighbours that they are, as the type of a neighbour on the surface depends on that, unless cells are triangles. Two
/// bytes a vertex, by GALE's id; what it has of ghosts says nothing. Copies share them.
template <class Memory>
class VertexTypes {
 public:
  VertexTypes() = default;
  explicit VertexTypes(const Mesh& mesh) : VertexTypes(mesh.vertices(), mesh.dimension()) {}
  VertexTypes(Id vertices, int dimension)
      : dimension_(dimension),
        own_(allocate<Bytes>("GALE::vertex_types", vertices)),
        told_("GALE::surface_neighbours", (vertices + 3) / 4 * 4) {}  // whole words, as atomic_or takes

  /// Sets what a vertex is by its own link, and tells its neighbours if it is on the surface.
  KOKKOS_FORCEINLINE_FUNCTION void set(const std::uint64_t* keys, Id v, const Row& neighbours,
                                       const LinkTopology& topology) const {
    const CriticalType type = dimension_ == 3 ? type_of(topology) : type_on_triangles(topology);
    own_(v) = static_cast<std::uint8_t>(static_cast<int>(type) | (topology.on_surface ? surface_bit : 0));
    if (!topology.on_surface || dimension_ == 2) return;
    for (const Id neighbour : neighbours) tell(keys, neighbour, v);
  }

  /// Tells a vertex that a neighbour of it is on the surface, and whether that is above it or below.
  KOKKOS_FORCEINLINE_FUNCTION void tell(const std::uint64_t* keys, Id v, Id neighbour) const {
    const std::uint8_t what = keys[neighbour] > keys[v] ? upper_on_surface : lower_on_surface;
    atomic_or(told_.data() + v, what);
  }

  /// Once all are set and told.
  KOKKOS_FUNCTION CriticalType type(Id v) const {
    const auto type = static_cast<CriticalType>(own_(v) & type_mask);
    if (type != CriticalType::regular || dimension_ == 2 || !on_surface(v)) return type;
    if (told_(v) == upper_on_surface) return CriticalType::saddle1;
    if (told_(v) == lower_on_surface) return CriticalType::saddle2;
    return CriticalType::regular;
  }
  KOKKOS_FUNCTION bool on_surface(Id v) const { return own_(v) & surface_bit; }

 private:
  using Bytes = Array<std::uint8_t, Memory>;
  static constexpr std::uint8_t type_mask = 7, surface_bit = 8, upper_on_surface = 1, lower_on_surface = 2;

  int dimension_ = 3;
  Bytes own_, told_;
};

/// The owned vertices that aren't regular, from types that a sweep of these has left in the memory of `space`, and the
/// counts of all ranks. Collective: ghosts on the surface tell their neighbours, too, as their owners say.
template <class Space>
CriticalPoints collect(const Space& space, const VertexOrder& order, const VertexTypes<MemoryOf<Space>>& types);

/// The critical points of a grid's field: what is below each vertex is a word of bits, of which a table says the rest
/// where all eight cubes around the vertex are there. Reads nothing but keys, which a device may have.
template <class Space>
CriticalPoints critical_points_of_grid(const Space& space, const VertexOrder& order, const SweepOptions& options);

}  // namespace gale::detail
