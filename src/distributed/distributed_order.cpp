#include <limits>
#include <memory>
#include <string>
#include <type_traits>

#include <gale/algorithms/order/each_value.hpp>
#include <gale/distributed/distributed_order.hpp>
#include <gale/distributed/exchange_plan.hpp>

namespace gale::detail {

namespace {

/// Throws on all ranks if one holds a vertex without a value; names the least one.
template <class Value>
void refuse_nan(const DistributedMesh& mesh, const Array<Value, HostMemory>& values) {
  if constexpr (std::is_floating_point_v<Value>) {
    constexpr GlobalId none = std::numeric_limits<GlobalId>::max();
    const auto& ids = mesh.vertex_ids();
    const GlobalId here = reduce_min("GALE::find_nan", HostSpace(), values.extent(0), none,
                                     [&](Offset i) { return values(i) != values(i) ? ids(i) : none; });
    const GlobalId bad = mesh.ranks().least(here);
    if (bad < none) throw SharedError("vertex " + std::to_string(bad) + " has no field value: it is NaN");
  }
}

}  // namespace

template <class Value>
VertexOrder local_order(const DistributedMesh& mesh, const FieldValues<Value, HostMemory>& given) {
  Array<Value, HostMemory> values;
  together(mesh.ranks(), [&] {
    if (static_cast<Offset>(given.extent(0)) != mesh.given_vertices()) {
      throw Error("the field has " + std::to_string(given.extent(0)) + " values, this part of the mesh " +
                  std::to_string(mesh.given_vertices()) + " vertices");
    }
    values = allocate<Array<Value, HostMemory>>("GALE::local_values", mesh.vertex_ids().extent(0));
  });
  mesh.from_givers()(mesh.ranks(), given.data(), values.data());
  refuse_nan(mesh, values);
  std::unique_ptr<const VertexOrder> order;
  together(mesh.ranks(), [&] { order = std::make_unique<const VertexOrder>(mesh.local(), values); });
  return *order;
}

#define GALE_INSTANTIATE(Value) \
  template GALE_EXPORT VertexOrder local_order(const DistributedMesh&, const FieldValues<Value, HostMemory>&)
GALE_FOR_EACH_VALUE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
