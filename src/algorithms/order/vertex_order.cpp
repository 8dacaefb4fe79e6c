#include <string>
#include <type_traits>

#include <gale/algorithms/order/each_value.hpp>
#include <gale/algorithms/order/ordered_bits.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

template <class Space, class Value>
void refuse_nan(const Space& space, const FieldValues<Value, MemoryOf<Space>>& values) {
  if constexpr (std::is_floating_point_v<Value>) {
    const auto count = static_cast<Offset>(values.extent(0));
    const Offset bad = reduce_min(
        "GALE::find_nan", space, count, count, KOKKOS_LAMBDA(Offset i) { return values(i) != values(i) ? i : count; });
    if (bad < count) throw Error("vertex " + std::to_string(bad) + " has no field value: it is NaN");
  }
}

/// Value and input id fit one key.
template <class Space, class Value>
void fill_keys(const Space& space, const Mesh& mesh, const FieldValues<Value, MemoryOf<Space>>& values,
               const Keys<Space>& keys) {
  const Id* const input = mesh.vertex_input<MemoryOf<Space>>().data();
  parallel_for(
      "GALE::order_keys", space, mesh.vertices(), KOKKOS_LAMBDA(Offset v) {
        keys(v) = std::uint64_t(ordered_bits(values(input[v]))) << 32 | static_cast<std::uint32_t>(input[v]);
      });
}

/// The place of each value among all.
template <class Space, class Value>
void fill_ranks(const Space& space, const Mesh& mesh, const FieldValues<Value, MemoryOf<Space>>& values,
                const Keys<Space>& keys) {
  const Offset count = mesh.vertices();
  const auto by_rank = allocate<Array<Id, MemoryOf<Space>>>("GALE::order_inputs", count);
  parallel_for(
      "GALE::order_bits", space, count, KOKKOS_LAMBDA(Offset i) {
        keys(i) = ordered_bits(values(i));
        by_rank(i) = static_cast<Id>(i);
      });
  stable_sort_by_key(space, keys, by_rank);
  const Id* const internal = mesh.vertex_internal<MemoryOf<Space>>().data();
  parallel_for(
      "GALE::order_ranks", space, count,
      KOKKOS_LAMBDA(Offset rank) { keys(internal[by_rank(rank)]) = static_cast<std::uint64_t>(rank); });
}

/// Ends with a fence: others use the keys on instances of their own.
template <class Space, class Value>
Mirrored<std::uint64_t> make_keys(const Space& space, const Mesh& mesh,
                                  const FieldValues<Value, MemoryOf<Space>>& values) {
  refuse_nan<Space, Value>(space, values);
  const auto keys = allocate<Keys<Space>>("GALE::order_keys", mesh.vertices());
  if constexpr (sizeof(Value) == 8) {
    fill_ranks<Space, Value>(space, mesh, values, keys);
  } else {
    fill_keys<Space, Value>(space, mesh, values, keys);
  }
  space.fence();
  return keys;
}

}  // namespace

template <class Value, class Memory>
Mirrored<std::uint64_t> order_keys(const Mesh& mesh, const FieldValues<Value, Memory>& values) {
  if (values.extent(0) != static_cast<std::size_t>(mesh.vertices())) {
    throw Error("the field has " + std::to_string(values.extent(0)) + " values, the mesh " +
                std::to_string(mesh.vertices()) + " vertices");
  }
  return in_worker_or_host_space(mesh, [&](const auto& space) {
    const auto here = in_memory<MemoryOf<std::decay_t<decltype(space)>>>(values);
    return make_keys<std::decay_t<decltype(space)>, Value>(space, mesh, here);
  });
}

#define GALE_INSTANTIATE_FOR(Value, Memory) \
  template GALE_EXPORT Mirrored<std::uint64_t> order_keys(const Mesh&, const FieldValues<Value, Memory>&)
#if defined(GALE_HAS_DEVICE)
#define GALE_INSTANTIATE(Value)            \
  GALE_INSTANTIATE_FOR(Value, HostMemory); \
  GALE_INSTANTIATE_FOR(Value, WorkerMemory)
#else
#define GALE_INSTANTIATE(Value) GALE_INSTANTIATE_FOR(Value, HostMemory)
#endif
GALE_FOR_EACH_VALUE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_FOR

}  // namespace gale::detail
