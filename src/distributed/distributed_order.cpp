#include <limits>
#include <memory>
#include <string>
#include <type_traits>

#include <gale/algorithms/order/each_value.hpp>
#include <gale/base/worker_or_host.hpp>
#include <gale/distributed/distributed_order.hpp>
#include <gale/distributed/exchange_plan.hpp>

namespace gale::detail {

/// An order, or a vertex that has no place in it.
struct Ordered {
  std::shared_ptr<const VertexOrder> order;
  Offset bad;
};

namespace {

/// The least local input id of a vertex without a value; `count` if all have one.
template <class Space, class Value>
Offset find_nan(const Space& space, const Array<Value, MemoryOf<Space>>& values) {
  const auto count = static_cast<Offset>(values.extent(0));
  if constexpr (std::is_floating_point_v<Value>) {
    return reduce_min(
        "GALE::find_nan", space, count, count, KOKKOS_LAMBDA(Offset i) { return values(i) != values(i) ? i : count; });
  }
  return count;
}

template <class Space, class Value>
Ordered order_in(const Space& space, const DistributedMesh& mesh, const FieldValues<Value, HostMemory>& given,
                 const Dealt<Value>& fetched) {
  const Mesh& local = mesh.local();
  const auto values = allocate<Array<Value, MemoryOf<Space>>>("GALE::local_values", local.vertices());
  mesh.from_givers().fill(space, given.data(), fetched, values.data());
  const Offset bad = find_nan(space, values);
  if (bad < local.vertices()) return {nullptr, bad};
  return {std::make_shared<const VertexOrder>(local, values), bad};
}

}  // namespace

template <class Value>
VertexOrder local_order(const DistributedMesh& mesh, const FieldValues<Value, HostMemory>& given) {
  Ordered found{};
  const auto require_count = [&] {
    if (static_cast<Offset>(given.extent(0)) == mesh.given_vertices()) return;
    throw Error("the field has " + std::to_string(given.extent(0)) + " values, this part of the mesh " +
                std::to_string(mesh.given_vertices()) + " vertices");
  };
  together(mesh.ranks(), require_count);
  if (mesh.from_givers().keeps_all()) {
    together(mesh.ranks(), [&] { found.order = std::make_shared<const VertexOrder>(mesh.local(), given); });
    return *found.order;
  }
  const auto fetched = mesh.from_givers().fetch<Value>(mesh.ranks(), [&](Id place) { return given(place); });
  together(mesh.ranks(), [&] {
    found = in_worker_or_host_space(mesh.local().on_device(),
                                    [&](const auto& space) { return order_in(space, mesh, given, fetched); });
  });
  constexpr GlobalId none = std::numeric_limits<GlobalId>::max();
  const GlobalId bad = mesh.ranks().least(found.order ? none : mesh.vertex_id(static_cast<Id>(found.bad)));
  if (bad < none) throw SharedError("vertex " + std::to_string(bad) + " has no field value: it is NaN");
  return *found.order;
}

#define GALE_INSTANTIATE(Value) \
  template GALE_EXPORT VertexOrder local_order(const DistributedMesh&, const FieldValues<Value, HostMemory>&)
GALE_FOR_EACH_VALUE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
