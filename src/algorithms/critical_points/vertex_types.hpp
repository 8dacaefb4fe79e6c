#pragma once

#include <cstdint>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/links/small_link.hpp>

namespace gale::detail {

/// What a vertex is by its own link.
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
/// neighbours that they are, as the type of a neighbour on the surface depends on that. A view of two bytes a vertex,
/// wherever they lie.
class VertexTypes {
 public:
  VertexTypes() = default;

  /// `told` begins with zeros.
  KOKKOS_FUNCTION VertexTypes(std::uint8_t* own, std::uint8_t* told) : own_(own), told_(told) {}

  KOKKOS_FUNCTION void set(Id v, const LinkTopology& topology) const {
    own_[v] = static_cast<std::uint8_t>(static_cast<int>(type_of(topology)) | (topology.on_surface ? surface_bit : 0));
  }

  /// What a vertex on the surface tells a neighbour: whether it is above it or below.
  KOKKOS_FORCEINLINE_FUNCTION static std::uint8_t seen_from(const std::uint64_t* keys, Id neighbour, Id vertex) {
    return keys[vertex] > keys[neighbour] ? upper_on_surface : lower_on_surface;
  }
  KOKKOS_FUNCTION void tell(Id neighbour, std::uint8_t what) const {
#if defined(GALE_ON_DEVICE)
    // A word at a time, as atomics are: of four neighbours.
    auto* const words = reinterpret_cast<unsigned*>(told_ - reinterpret_cast<std::uintptr_t>(told_) % 4);
    const auto at = static_cast<std::size_t>(told_ + neighbour - reinterpret_cast<std::uint8_t*>(words));
    atomicOr(words + at / 4, unsigned(what) << (8 * (at % 4)));
#else
    __atomic_fetch_or(told_ + neighbour, what, __ATOMIC_RELAXED);
#endif
  }

  /// Once all are set and told.
  KOKKOS_FUNCTION CriticalType type(Id v) const {
    const auto type = static_cast<CriticalType>(own_[v] & type_mask);
    if (type != CriticalType::regular || !on_surface(v)) return type;
    if (told_[v] == upper_on_surface) return CriticalType::saddle1;
    if (told_[v] == lower_on_surface) return CriticalType::saddle2;
    return CriticalType::regular;
  }

  KOKKOS_FUNCTION bool on_surface(Id v) const { return own_[v] & surface_bit; }

 private:
  static constexpr std::uint8_t type_mask = 7, surface_bit = 8, upper_on_surface = 1, lower_on_surface = 2;

  std::uint8_t* own_ = nullptr;
  std::uint8_t* told_ = nullptr;
};

}  // namespace gale::detail
