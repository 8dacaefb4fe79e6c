#pragma once

#include <cstdint>

#include <gale/base/key_table.hpp>

namespace gale::detail {

/// The edges of walls that grow side by side: a table that kernels insert into. An edge of a wall has the least of the
/// wall's triangles that it isn't paired with, by its number, and whether there are more of these. Copies share it.
class WallTable {
 public:
  WallTable() = default;

  /// With so many places, a power of two; `edge_bits` suffice for the numbers of edges. Throws OutOfMemory.
  WallTable(const WorkerSpace& space, Offset places, int edge_bits)
      : edges_(space, places),
        above_(allocate<Array<std::uint32_t, WorkerMemory>>("GALE::triangles_above", places)),
        edge_bits_(edge_bits) {
    fill("GALE::triangles_above", space, above_, no_triangle);
  }

  Offset places() const { return edges_.places(); }

  /// Copies the edge at a place, if there is one, to a larger table.
  KOKKOS_FUNCTION void copy_to(const WallTable& larger, Offset place) const {
    if (edges_.at(place) == KeyTable::none) return;
    bool is_new;
    larger.above_(larger.edges_.insert(edges_.at(place), is_new)) = above_(place);
  }

  /// The place of an edge of a wall, by the number that it has among all edges; `is_new` says whether it was inserted
  /// now.
  KOKKOS_FUNCTION std::uint64_t insert(Id wall, Offset edge, bool& is_new) const {
    return edges_.insert(key(wall, edge), is_new);
  }

  /// The place of an edge that is there.
  KOKKOS_FUNCTION std::uint64_t find(Id wall, Offset edge) const { return edges_.find(key(wall, edge)); }

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

  KOKKOS_FUNCTION std::uint64_t key(Id wall, Offset edge) const {
    return std::uint64_t(wall) << edge_bits_ | std::uint64_t(edge);
  }

  KeyTable edges_;
  Array<std::uint32_t, WorkerMemory> above_;
  int edge_bits_ = 0;
};

}  // namespace gale::detail
