#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/first_tetrahedra.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/algorithms/morse_smale/manifolds.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;
template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

template <class Space>
Mirrored<Id> descending_in(const Space& space, const DiscreteGradient& gradient) {
  const auto next = with_ends(space, gradient.store().vertex_successors(), gradient.critical().vertices);
  jump(space, next);
  const auto input = gradient.mesh().vertex_input<MemoryOf<Space>>();
  const auto manifolds = allocate<Ids<Space>>("GALE::descending_manifolds", next.extent(0));
  parallel_for(
      "GALE::descending_manifolds", space, next.extent(0),
      KOKKOS_LAMBDA(Offset v) { manifolds(input(v)) = place_of_end(next(v)); });
  space.fence();
  return manifolds;
}

template <class Space>
Mirrored<Id> ascending_in(const Space& space, const DiscreteGradient& gradient) {
  const auto next = with_ends(space, gradient.store().tetrahedron_successors(), gradient.critical().tetrahedra);
  jump(space, next);
  const auto first = first_tetrahedra(space, gradient.mesh());
  const auto input = gradient.mesh().vertex_input<MemoryOf<Space>>();
  const auto manifolds = allocate<Ids<Space>>("GALE::ascending_manifolds", first.extent(0));
  parallel_for(
      "GALE::ascending_manifolds", space, first.extent(0), KOKKOS_LAMBDA(Offset v) {
        const Id tetrahedron = pair_second(first(v));
        manifolds(input(v)) =
            first(v) == no_first || next(tetrahedron) == path_outside ? no_id : place_of_end(next(tetrahedron));
      });
  space.fence();
  return manifolds;
}

constexpr std::uint64_t no_pair = ~std::uint64_t(0);

template <class Space>
std::pair<Mirrored<Id>, Id> pairs_in(const Space& space, const Mirrored<Id>& ascending,
                                     const Mirrored<Id>& descending) {
  const Offset count = ascending.size();
  const auto up = ascending.in<MemoryOf<Space>>(), down = descending.in<MemoryOf<Space>>();
  const auto keys = allocate<Keys<Space>>("GALE::manifold_pairs", count);
  const auto vertices = allocate<Ids<Space>>("GALE::manifold_vertices", count);
  parallel_for(
      "GALE::manifold_pairs", space, count, KOKKOS_LAMBDA(Offset v) {
        keys(v) = up(v) == no_id ? no_pair : pair_key(up(v), down(v));
        vertices(v) = static_cast<Id>(v);
      });
  stable_sort_by_key(space, keys, vertices);
  const auto before = allocate<Ids<Space>>("GALE::manifold_number", count + 1);  // how many pairs begin earlier
  const Id distinct = exclusive_scan(
      "GALE::count_manifolds", space, count, before,
      KOKKOS_LAMBDA(Offset i) { return keys(i) != no_pair && (i == 0 || keys(i) != keys(i - 1)); });
  const auto manifolds = allocate<Ids<Space>>("GALE::morse_smale_manifolds", count);
  parallel_for(
      "GALE::morse_smale_manifolds", space, count,
      KOKKOS_LAMBDA(Offset i) { manifolds(vertices(i)) = keys(i) == no_pair ? no_id : before(i + 1) - 1; });
  space.fence();
  return {manifolds, distinct};
}

template <class Space>
Mirrored<Id> renamed_in(const Space& space, const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  const auto from = manifolds.in<MemoryOf<Space>>();
  const auto name = in_memory<MemoryOf<Space>>(Array<const Id, HostMemory>(names.data(), names.size()));
  const auto to = allocate<Ids<Space>>("GALE::renamed_manifolds", from.extent(0));
  parallel_for(
      "GALE::rename_manifolds", space, from.extent(0),
      KOKKOS_LAMBDA(Offset v) { to(v) = from(v) == no_id ? no_id : name(from(v)); });
  space.fence();
  return to;
}

}  // namespace

Mirrored<Id> descending_manifolds(const DiscreteGradient& gradient) {
  return in_worker_or_host_space(gradient.mesh(), [&](const auto& space) { return descending_in(space, gradient); });
}

Mirrored<Id> ascending_manifolds(const DiscreteGradient& gradient) {
  return in_worker_or_host_space(gradient.mesh(), [&](const auto& space) { return ascending_in(space, gradient); });
}

std::pair<Mirrored<Id>, Id> morse_smale_manifolds(const Mirrored<Id>& ascending, const Mirrored<Id>& descending) {
  return in_worker_or_host_space(ascending.on_device(),
                                 [&](const auto& space) { return pairs_in(space, ascending, descending); });
}

Mirrored<Id> renamed(const Mirrored<Id>& manifolds, const std::vector<Id>& names) {
  return in_worker_or_host_space(manifolds.on_device(),
                                 [&](const auto& space) { return renamed_in(space, manifolds, names); });
}

}  // namespace gale::detail
