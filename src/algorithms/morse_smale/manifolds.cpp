#include <gale/algorithms/morse_smale/manifolds.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

using Ids = Array<Id, WorkerMemory>;
using Keys = Array<std::uint64_t, WorkerMemory>;

/// What stands for the end of a path at the critical simplex with a place.
KOKKOS_FORCEINLINE_FUNCTION constexpr Id end_at(Id place) { return -2 - place; }
KOKKOS_FORCEINLINE_FUNCTION constexpr Id place_of_end(Id end) { return -2 - end; }

/// What stands for the end of a path that leaves through the surface: the place no_id.
constexpr Id outside = -1;

/// A copy of successors in the workers' memory, in which critical simplices lead to their places, and those whose path
/// leaves to `outside`.
Ids with_ends(const Array<const Id, HostMemory>& successors, const std::vector<Id>& critical) {
  const auto next = allocate<Ids>("GALE::next_on_path", successors.extent(0));
  const auto from = on_worker(successors);
  parallel_for(
      "GALE::begin_paths", WorkerSpace(), from.extent(0), KOKKOS_LAMBDA(Offset i) {
        const Id successor = from(i);
        next(i) = successor < no_id ? outside : successor;
      });
  const auto places = on_worker(Array<const Id, HostMemory>(critical.data(), critical.size()));
  parallel_for(
      "GALE::end_paths", WorkerSpace(), places.extent(0),
      KOKKOS_LAMBDA(Offset i) { next(places(i)) = end_at(static_cast<Id>(i)); });
  return next;
}

/// Pointer jumping: afterwards each entry is the end of its path. Threads may read an entry before or after another one
/// changes it: both lead to the same end.
void jump(const Ids& next) {
  constexpr int jumps_a_pass = 4;
  const Offset count = next.extent(0);
  while (true) {
    const Offset open = reduce_sum(
        "GALE::jump", WorkerSpace(), count, KOKKOS_LAMBDA(Offset i) {
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
Keys first_tetrahedra(const Mesh& mesh) {
  const auto first = allocate<Keys>("GALE::first_tetrahedra", mesh.vertices());
  const EncodedMesh<WorkerMemory> encoded = mesh.worker();
  const auto input = mesh.tetrahedron_input_on_worker();
  parallel_for(
      "GALE::first_tetrahedra", WorkerSpace(), mesh.segments(), KOKKOS_LAMBDA(Offset s) {
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

HostIds to_host(const Ids& ids) { return on_host(ids); }

}  // namespace

HostIds descending_manifolds(const DiscreteGradient& gradient) {
  const Ids next = with_ends(gradient.vertex_successors(), gradient.critical().vertices);
  jump(next);
  const auto input = gradient.mesh().vertex_input_on_worker();
  const auto manifolds = allocate<Ids>("GALE::descending_manifolds", next.extent(0));
  parallel_for(
      "GALE::descending_manifolds", WorkerSpace(), next.extent(0),
      KOKKOS_LAMBDA(Offset v) { manifolds(input(v)) = place_of_end(next(v)); });
  return to_host(manifolds);
}

HostIds ascending_manifolds(const DiscreteGradient& gradient) {
  const Ids next = with_ends(gradient.tetrahedron_successors(), gradient.critical().tetrahedra);
  jump(next);
  const Keys first = first_tetrahedra(gradient.mesh());
  const auto input = gradient.mesh().vertex_input_on_worker();
  const auto manifolds = allocate<Ids>("GALE::ascending_manifolds", first.extent(0));
  parallel_for(
      "GALE::ascending_manifolds", WorkerSpace(), first.extent(0), KOKKOS_LAMBDA(Offset v) {
        const Id tetrahedron = pair_second(first(v));
        manifolds(input(v)) =
            first(v) == none || next(tetrahedron) == outside ? no_id : place_of_end(next(tetrahedron));
      });
  return to_host(manifolds);
}

std::pair<HostIds, Id> morse_smale_manifolds(const HostIds& ascending, const HostIds& descending) {
  const Offset count = ascending.extent(0);
  const auto up = on_worker(ascending), down = on_worker(descending);
  const auto keys = allocate<Keys>("GALE::manifold_pairs", count);
  const auto vertices = allocate<Ids>("GALE::manifold_vertices", count);
  parallel_for(
      "GALE::manifold_pairs", WorkerSpace(), count, KOKKOS_LAMBDA(Offset v) {
        keys(v) = up(v) == no_id ? none : pair_key(up(v), down(v));
        vertices(v) = static_cast<Id>(v);
      });
  stable_sort_by_key(keys, vertices);
  const auto before = allocate<Ids>("GALE::manifold_number", count + 1);  // how many pairs begin earlier
  const Id distinct = exclusive_scan(
      "GALE::count_manifolds", WorkerSpace(), count, before,
      KOKKOS_LAMBDA(Offset i) { return keys(i) != none && (i == 0 || keys(i) != keys(i - 1)); });
  const auto manifolds = allocate<Ids>("GALE::morse_smale_manifolds", count);
  parallel_for(
      "GALE::morse_smale_manifolds", WorkerSpace(), count,
      KOKKOS_LAMBDA(Offset i) { manifolds(vertices(i)) = keys(i) == none ? no_id : before(i + 1) - 1; });
  return {to_host(manifolds), distinct};
}

}  // namespace gale::detail
