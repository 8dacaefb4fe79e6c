#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/algorithms/order/ordered_bits.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/error.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Keys = Array<std::uint64_t, MemoryOf<Space>>;

/// A field's values by their bits: all types of a width are one for what is compiled here.
template <class Raw, class Memory>
struct RawValues {
  FieldValues<Raw, Memory> bits;
  NumberKind kind;

  KOKKOS_FUNCTION BitsOf<Raw> ordered(Offset i) const { return ordered_bits(bits(i), kind); }

  /// A vertex's input id if it has no value; `none` if it has one.
  KOKKOS_FUNCTION Offset if_nan(Offset i, Offset vertex, Offset none) const {
    return is_nan(bits(i), kind) ? vertex : none;
  }
};

/// Value and input id fit one key.
template <class Space, class Raw>
Offset fill_keys(const Space& space, const Mesh& mesh, const RawValues<Raw, MemoryOf<Space>>& values,
                 const Keys<Space>& keys) {
  const Offset count = mesh.vertices();
  const OtherIds input = mesh.vertices_in_input<MemoryOf<Space>>();
  return reduce_min(
      "GALE::order_keys", space, count, count, KOKKOS_LAMBDA(Offset v) {
        const Id vertex = input[v];
        keys(v) = std::uint64_t(values.ordered(vertex)) << 32 | static_cast<std::uint32_t>(vertex);
        return values.if_nan(vertex, vertex, count);
      });
}

/// The place of each value among all.
template <class Space, class Raw>
Offset fill_ranks(const Space& space, const Mesh& mesh, const RawValues<Raw, MemoryOf<Space>>& values,
                  const Keys<Space>& keys) {
  const Offset count = mesh.vertices();
  const Offset bad = reduce_min(
      "GALE::order_bits", space, count, count, KOKKOS_LAMBDA(Offset i) {
        keys(i) = values.ordered(i);
        return values.if_nan(i, i, count);
      });
  if (bad < count) return bad;
  const auto by_rank = stable_sort_places(space, "GALE::order_inputs", keys);
  const OtherIds internal = mesh.vertices_of_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::order_ranks", space, count,
      KOKKOS_LAMBDA(Offset rank) { keys(internal[by_rank(rank)]) = static_cast<std::uint64_t>(rank); });
  return bad;
}

/// The keys of vertices, and the least input id of one without a value; their count if all have one.
struct FoundKeys {
  OrderKeys order;
  Offset bad;
};

/// Ends with a fence: others use the keys on instances of their own.
template <class Space, class Raw>
FoundKeys make_keys(const Space& space, const Mesh& mesh, const RawValues<Raw, MemoryOf<Space>>& values) {
  const auto keys = allocate<Keys<Space>>("GALE::order_keys", mesh.vertices());
  Offset bad;
  if constexpr (sizeof(Raw) == 8) {
    bad = fill_ranks(space, mesh, values, keys);
  } else {
    bad = fill_keys(space, mesh, values, keys);
  }
  space.fence();
  return {{keys}, bad};
}

/// Keys that compare on all ranks, where those of this rank don't.
template <class Space, class Raw>
Array<const std::uint64_t, HostMemory> shared_keys(const Space& space, const Mesh& mesh,
                                                   const RawValues<Raw, MemoryOf<Space>>& values) {
  if (sizeof(Raw) < 8 || mesh.exchange().ranks().size() == 1) return {};
  const auto keys = allocate<Keys<Space>>("GALE::shared_keys", mesh.vertices());
  const OtherIds input = mesh.vertices_in_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::shared_keys", space, mesh.vertices(), KOKKOS_LAMBDA(Offset v) { keys(v) = values.ordered(input[v]); });
  space.fence();
  return on_host(keys);
}

/// Makes keys of a value for each vertex of the mesh.
template <class Raw, class Memory>
OrderKeys keys_of_all(const Mesh& mesh, const RawValues<Raw, Memory>& values) {
  return in_worker_or_host_space(mesh, [&](const auto& space) {
    using Space = std::decay_t<decltype(space)>;
    const auto copy = in_memory<MemoryOf<Space>>(values.bits);
    const FoundKeys found = make_keys(space, mesh, RawValues<Raw, MemoryOf<Space>>{copy, values.kind});
    if (found.bad < mesh.vertices()) throw Error(detail::without_value(found.bad));
    return found.order;
  });
}

/// Room for a value for each vertex of a part, with those that this rank has handed over one after the other.
template <class Space, class Raw>
Array<Raw, MemoryOf<Space>> own_values(const Space& space, const Mesh& mesh, const RawValues<Raw, HostMemory>& given) {
  const auto values = allocate<Array<Raw, MemoryOf<Space>>>("GALE::local_values", mesh.vertices());
  mesh.exchange().from_givers().fill_run(space, given.bits.data(), values.data());
  return values;
}

/// `own`: what own_values() has made for the workers, if it was asked.
template <class Space, class Raw>
FoundKeys part_keys_in(const Space& space, const Mesh& mesh, const RawValues<Raw, HostMemory>& given,
                       const std::optional<Array<Raw, WorkerMemory>>& own, const EntriesByRank<Raw>& fetched) {
  Array<Raw, MemoryOf<Space>> values;
  if constexpr (is_device<Space>) {
    if (own) values = *own;
  }
  if (values.data() == nullptr) values = own_values(space, mesh, given);
  mesh.exchange().from_givers().fill_others(space, given.bits.data(), fetched, values.data());
  const RawValues<Raw, MemoryOf<Space>> all{FieldValues<Raw, MemoryOf<Space>>(values.data(), values.extent(0)),
                                            given.kind};
  FoundKeys found = make_keys(space, mesh, all);
  found.order.values = shared_keys(space, mesh, all);
  return found;
}

/// Makes keys of a value for each vertex that this rank has handed over. Collective.
template <class Raw>
OrderKeys keys_of_part(const Mesh& mesh, const RawValues<Raw, HostMemory>& given) {
  const Exchange& exchange = mesh.exchange();
  FoundKeys found{{}, 0};
  if (exchange.from_givers().keeps_all()) {
    together(exchange.ranks(), [&] { found.order = keys_of_all(mesh, given); });
    return found.order;
  }
  std::optional<Array<Raw, WorkerMemory>> own;
  EntriesByRank<Raw> fetched;
  // To a device go the part's own values while others' come; if there is no room, part_keys_in finds that, too.
  const auto copy = [&] { tried([&] { own = own_values(WorkerSpace(), mesh, given); }); };
  const auto fetch = [&] {
    fetched = exchange.from_givers().fetch<Raw>(exchange.ranks(), [&](Id place) { return given.bits(place); });
  };
  if (mesh.on_device()) {
    meanwhile(copy, fetch);
  } else {
    fetch();
  }
  together(exchange.ranks(), [&] {
    found = in_worker_or_host_space(
        mesh, [&](const auto& space) { return part_keys_in(space, mesh, given, std::exchange(own, {}), fetched); });
  });
  constexpr GlobalId none = std::numeric_limits<GlobalId>::max();
  const bool is_bad = found.bad < mesh.vertices();
  const GlobalId bad = exchange.ranks().least(is_bad ? mesh.vertex_id(static_cast<Id>(found.bad)) : none);
  if (bad < none) throw SharedError(detail::without_value(bad));
  return found.order;
}

/// Values as make_keys reads them.
template <class Value, class Memory>
auto raw(const FieldValues<Value, Memory>& values) {
  using Raw = RawOf<sizeof(Value)>;
  const FieldValues<Raw, Memory> bits(reinterpret_cast<const Raw*>(values.data()), values.extent(0));
  return RawValues<Raw, Memory>{bits, kind_of<Value>};
}

template <class Raw, class Memory>
OrderKeys keys_of(const Mesh& mesh, const RawValues<Raw, Memory>& values) {
  const Offset given = mesh.exchange().given_vertices(), count = given < 0 ? Offset(mesh.vertices()) : given;
  together(mesh.exchange().ranks(), [&] {
    if (static_cast<Offset>(values.bits.extent(0)) == count) return;
    throw Error("the field has " + std::to_string(values.bits.extent(0)) + " values, " +
                (mesh.is_part() ? "this part of the mesh " : "the mesh ") + std::to_string(count) + " vertices");
  });
  if (!mesh.is_part()) return keys_of_all(mesh, values);
  const auto here = on_host(values.bits);
  return keys_of_part(
      mesh, RawValues<Raw, HostMemory>{FieldValues<Raw, HostMemory>(here.data(), here.extent(0)), values.kind});
}

}  // namespace

template <class Value, class Memory>
OrderKeys order_keys(const Mesh& mesh, const FieldValues<Value, Memory>& values) {
  return keys_of(mesh, raw(values));
}

OrderKeys keys_of_places(const Mesh& mesh, const FieldValues<Id, HostMemory>& places) {
  if (static_cast<Offset>(places.extent(0)) != Offset(mesh.vertices()))
    throw Error("there are " + std::to_string(places.extent(0)) + " places, the mesh has " +
                std::to_string(mesh.vertices()) + " vertices");
  return keys_of_all(mesh, raw(places));
}

namespace {

/// The vertex of some, which are there, that has the highest key.
template <class Space>
Id highest_in(const Space& space, const Array<const std::uint64_t, MemoryOf<Space>>& keys, const Interval& some) {
  if constexpr (is_device<Space>) {
    const Id first = some.first;
    const Offset count = some.size();
    const std::uint64_t least = reduce_min(
        "GALE::highest_key", space, count, ~std::uint64_t(0), KOKKOS_LAMBDA(Offset i) { return ~keys(first + i); });
    return static_cast<Id>(first + reduce_min(
                                       "GALE::highest_vertex", space, count, count,
                                       KOKKOS_LAMBDA(Offset i) { return ~keys(first + i) == least ? i : count; }));
  } else {
    const std::uint64_t* const first = keys.data() + some.first;
    const auto highest_of_parts = of_parts("GALE::highest_vertex", some.size(), [&](Offset begin, Offset end) {
      return std::max_element(first + begin, first + end);
    });
    const auto highest = std::max_element(highest_of_parts.begin(), highest_of_parts.end(),
                                          [](const auto* a, const auto* b) { return *a < *b; });
    return static_cast<Id>(some.first + (*highest - first));
  }
}

}  // namespace

#define GALE_INSTANTIATE_FOR(Value, Memory) \
  template GALE_EXPORT OrderKeys order_keys(const Mesh&, const FieldValues<Value, Memory>&)
#if defined(GALE_HAS_DEVICE)
#define GALE_INSTANTIATE(Value)            \
  GALE_INSTANTIATE_FOR(Value, HostMemory); \
  GALE_INSTANTIATE_FOR(Value, WorkerMemory)
#else
#define GALE_INSTANTIATE(Value) GALE_INSTANTIATE_FOR(Value, HostMemory)
#endif
GALE_INSTANTIATE(char);
GALE_INSTANTIATE(signed char);
GALE_INSTANTIATE(unsigned char);
GALE_INSTANTIATE(short);
GALE_INSTANTIATE(unsigned short);
GALE_INSTANTIATE(int);
GALE_INSTANTIATE(unsigned int);
GALE_INSTANTIATE(long);
GALE_INSTANTIATE(unsigned long);
GALE_INSTANTIATE(long long);
GALE_INSTANTIATE(unsigned long long);
GALE_INSTANTIATE(float);
GALE_INSTANTIATE(double);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_FOR

}  // namespace gale::detail

namespace gale {

std::vector<std::uint64_t> VertexOrder::keys_of(const std::vector<Id>& vertices) const {
  return detail::entries_at(all_.keys, vertices);
}

std::vector<std::uint64_t> VertexOrder::value_keys_of(const std::vector<Id>& vertices) const {
  std::vector<std::uint64_t> values(vertices.size());
  if (has_short_values()) values = keys_of(vertices);
  parallel_for("GALE::value_keys", HostExecutionSpace(), vertices.size(),
               [&](Offset i) { values[i] = has_short_values() ? values[i] >> 32 : all_.values(vertices[i]); });
  return values;
}

Id VertexOrder::highest(Interval some) const {
  if (some.size() == 0) return no_id;
  return in_worker_or_host_space(all_.keys.on_device(), [&](const auto& space) {
    return detail::highest_in(space, all_.keys.in<MemoryOf<std::decay_t<decltype(space)>>>(), some);
  });
}

}  // namespace gale
