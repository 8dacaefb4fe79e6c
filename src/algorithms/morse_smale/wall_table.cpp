#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

WallTable::WallTable(const WorkerSpace& space, Offset places, int edge_bits)
    : edges_(allocate<Array<std::uint64_t, WorkerMemory>>("GALE::wall_edges", places)),
      above_(allocate<Array<std::uint32_t, WorkerMemory>>("GALE::triangles_above", places)),
      edge_bits_(edge_bits) {
  Kokkos::deep_copy(space, edges_, none);
  Kokkos::deep_copy(space, above_, no_triangle);
}

void WallTable::grow(const WorkerSpace& space) {
  const WallTable old = *this, larger(space, 2 * places(), edge_bits_);
  parallel_for(
      "GALE::grow_wall_table", space, old.places(), KOKKOS_LAMBDA(Offset i) {
        if (old.edges_(i) == none) return;
        bool is_new;
        larger.above_(larger.insert(old.edges_(i), is_new)) = old.above_(i);
      });
  space.fence();
  *this = larger;
}

}  // namespace gale::detail
