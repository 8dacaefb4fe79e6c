#pragma once

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/transfer.hpp>
#include <gale/distributed/distributed_mesh.hpp>

namespace gale {

namespace detail {

/// The order of the vertices that this rank holds, from a value for each vertex that it has handed over.
template <class Value>
GALE_EXPORT VertexOrder local_order(const DistributedMesh& mesh, const FieldValues<Value, HostMemory>& given);

}  // namespace detail

/// A total order of the vertices of a mesh on several ranks: by field value, then by global id.
class DistributedOrder {
 public:
  /// From a value for each vertex that this rank has handed over, in that order: a View of rank 1, in host memory or a
  /// device's, of any type that VertexOrder takes. Of a vertex that came from several ranks the lowest rank's value
  /// counts. Collective: one exchange. Throws gale::Error on all ranks if a value is NaN, naming the least such vertex,
  /// and if there aren't as many values as vertices.
  template <class View>
  DistributedOrder(const DistributedMesh& mesh, const View& values)
      : mesh_(mesh), local_(order_of(mesh, on_host(values))) {}

  /// The mesh whose vertices it orders.
  const DistributedMesh& mesh() const { return mesh_; }

  /// The order of this rank's local mesh: its vertices compare as they do among all.
  const VertexOrder& local() const { return local_; }

 private:
  template <class View>
  static VertexOrder order_of(const DistributedMesh& mesh, const View& values) {
    static_assert(View::rank == 1, "a value for each vertex");
    using Value = typename View::non_const_value_type;
    if (values.span() == values.size())
      return detail::local_order(mesh, detail::FieldValues<Value, HostMemory>(values.data(), values.extent(0)));
    const auto copy = allocate<Array<Value, HostMemory>>("GALE::field", values.extent(0));
    for (std::size_t i = 0; i < values.extent(0); ++i) copy(i) = values(i);
    return detail::local_order(mesh, detail::FieldValues<Value, HostMemory>(copy));
  }

  DistributedMesh mesh_;
  VertexOrder local_;
};

}  // namespace gale
