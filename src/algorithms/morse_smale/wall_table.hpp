#pragma once

#include <cstdint>

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Numbers the edges of several walls, for a KeyTable: `bits` suffice for the numbers of edges.
struct WallEdgeKeys {
  int bits = 0;

  KOKKOS_FUNCTION std::uint64_t operator()(Id wall, Offset edge) const {
    return std::uint64_t(wall) << bits | std::uint64_t(edge);
  }
};

/// What is above the edges of walls that have grown, for kernels: an edge of a wall has the least of the wall's
/// triangles that it isn't paired with, by its number, and whether there are more of these. Copies share it.
class WallTable {
 public:
  WallTable() = default;

  /// With edges at so many places that have no triangle yet. Throws OutOfMemory.
  WallTable(const WorkerSpace& space, Offset places)
      : above_(allocate<Array<std::uint32_t, WorkerMemory>>("GALE::triangles_above", places)) {
    fill("GALE::triangles_above", space, above_, no_triangle);
  }

  /// Says that a triangle is above the edge at a place. is_less(a, b) compares triangles by their numbers.
  template <class IsLess>
  KOKKOS_FUNCTION void put_above(std::uint64_t place, std::uint32_t triangle, const IsLess& is_less) const {
    std::uint32_t* const above = &above_(place);
    std::uint32_t there = atomic_compare_exchange(above, no_triangle, triangle);
    while (there != no_triangle) {
      const std::uint32_t least = there & ~several;
      const std::uint32_t both = several | (is_less(triangle, least) ? triangle : least);
      const std::uint32_t now = atomic_compare_exchange(above, there, both);
      if (now == there) return;
      there = now;
    }
  }

  KOKKOS_FUNCTION std::uint32_t least_above(std::uint64_t place) const { return above_(place) & ~several; }
  KOKKOS_FUNCTION bool are_several_above(std::uint64_t place) const { return (above_(place) & several) != 0; }

  static constexpr Offset most_triangles = (Offset(1) << 31) - 1;  ///< that it can number

 private:
  static constexpr std::uint32_t several = std::uint32_t(1) << 31, no_triangle = ~std::uint32_t(0);

  Array<std::uint32_t, WorkerMemory> above_;
};

}  // namespace gale::detail
