#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/manifolds.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;
template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

/// What stands for the end of a path at the critical simplex with a place.
KOKKOS_FORCEINLINE_FUNCTION constexpr Id end_at(Id place) { return -2 - place; }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id place_of_end(Id end) { return -2 - end; }

/// What stands for the end of a path that leaves through the surface: the place no_id.
constexpr Id outside = -1;

/// A copy of successors in a space's memory in which the critical ones lead to their places, and those that leave to
/// `outside`.
template <class Space>
Ids<Space> with_ends(const Space& space, const Mirrored<Id>& successors, const std::vector<Id>& critical) {
  const auto next = allocate<Ids<Space>>("GALE::next_on_path", successors.size());
  // A copy for the device alone goes when this is done.
  Array<const Id, MemoryOf<Space>> from;
  if (successors.on_device()) {
    from = successors.in<MemoryOf<Space>>();
  } else {
    from = in_memory<MemoryOf<Space>>(successors.in<HostMemory>());
  }
  parallel_for(
      "GALE::begin_paths", space, from.extent(0), KOKKOS_LAMBDA(Offset i) {
        const Id successor = from(i);
        next(i) = successor < no_id ? outside : successor;
      });
  const auto places = in_memory<MemoryOf<Space>>(Array<const Id, HostMemory>(critical.data(), critical.size()));
  parallel_for(
      "GALE::end_paths", space, places.extent(0),
      KOKKOS_LAMBDA(Offset i) { next(places(i)) = end_at(static_cast<Id>(i)); });
  return next;
}

/// Pointer jumping: afterwards each entry is the end of its path. Entries that others jump over meanwhile only get
/// closer to their ends.
template <class Space>
void jump(const Space& space, const Ids<Space>& next) {
  constexpr int jumps_a_pass = 4;
  const Offset count = next.extent(0);
  while (true) {
    const Offset open = reduce_sum(
        "GALE::jump", space, count, KOKKOS_LAMBDA(Offset i) {
          Id at = atomic_read(&next(i));
          if (at < 0) return 0;
          for (int k = 0; k < jumps_a_pass && at >= 0; ++k) at = atomic_read(&next(at));
          atomic_write(&next(i), at);
          return at >= 0 ? 1 : 0;
        });
    if (open == 0) return;
  }
}

constexpr std::uint64_t none = ~std::uint64_t(0);

/// For each vertex its tetrahedron of lowest input id, with that id in the upper half; `none` where it has no
/// tetrahedron.
template <class Space>
Keys<Space> first_tetrahedra(const Space& space, const Mesh& mesh) {
  const auto first = allocate<Keys<Space>>("GALE::first_tetrahedra", mesh.vertices());
  const auto encoded = mesh.encoded<MemoryOf<Space>>();
  const auto input = mesh.tetrahedron_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::first_tetrahedra", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        const Id begin = encoded.vertex_begin(s), end = encoded.vertex_begin(s + 1);
        for (Id v = begin; v < end; ++v) first(v) = none;
        const auto offer = [&](Id t) {
          const std::uint64_t key = pair_key(input(t), t);
          for (int corner = 0; corner < 4; ++corner) {
            const Id v = encoded.tetrahedra(t, corner);
            if (v >= begin && v < end && key < first(v)) first(v) = key;
          }
        };
        for (Id t = encoded.internal_begin(s); t < encoded.internal_begin(s + 1); ++t) offer(t);
        for (Offset i = encoded.external_begin(s); i < encoded.external_begin(s + 1); ++i) offer(encoded.external(i));
      });
  return first;
}

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
            first(v) == none || next(tetrahedron) == outside ? no_id : place_of_end(next(tetrahedron));
      });
  space.fence();
  return manifolds;
}

template <class Space>
std::pair<Mirrored<Id>, Id> pairs_in(const Space& space, const Mirrored<Id>& ascending,
                                     const Mirrored<Id>& descending) {
  const Offset count = ascending.size();
  const auto up = ascending.in<MemoryOf<Space>>(), down = descending.in<MemoryOf<Space>>();
  const auto keys = allocate<Keys<Space>>("GALE::manifold_pairs", count);
  const auto vertices = allocate<Ids<Space>>("GALE::manifold_vertices", count);
  parallel_for(
      "GALE::manifold_pairs", space, count, KOKKOS_LAMBDA(Offset v) {
        keys(v) = up(v) == no_id ? none : pair_key(up(v), down(v));
        vertices(v) = static_cast<Id>(v);
      });
  stable_sort_by_key(space, keys, vertices);
  const auto before = allocate<Ids<Space>>("GALE::manifold_number", count + 1);  // how many pairs begin earlier
  const Id distinct = exclusive_scan(
      "GALE::count_manifolds", space, count, before,
      KOKKOS_LAMBDA(Offset i) { return keys(i) != none && (i == 0 || keys(i) != keys(i - 1)); });
  const auto manifolds = allocate<Ids<Space>>("GALE::morse_smale_manifolds", count);
  parallel_for(
      "GALE::morse_smale_manifolds", space, count,
      KOKKOS_LAMBDA(Offset i) { manifolds(vertices(i)) = keys(i) == none ? no_id : before(i + 1) - 1; });
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
