#include <cstring>
#include <string>
#include <type_traits>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale {

namespace {

using Keys = Array<std::uint64_t, HostMemory>;

template <class Value>
using BitsOf = std::conditional_t<sizeof(Value) == 8, std::uint64_t, std::uint32_t>;

/// An unsigned number that compares as the value does.
template <class Value>
BitsOf<Value> ordered_bits(Value value) {
  using Bits = BitsOf<Value>;
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  if constexpr (std::is_floating_point_v<Value>) {
    value += Value(0);  // -0 becomes 0
    Bits bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits & sign ? ~bits : bits | sign;
  } else if constexpr (std::is_signed_v<Value>) {
    return static_cast<Bits>(value) ^ sign;
  } else {
    return value;
  }
}

template <class Value>
void refuse_nan([[maybe_unused]] const Value* values, [[maybe_unused]] Offset count) {
  if constexpr (std::is_floating_point_v<Value>) {
    const Offset bad = reduce_min("GALE::find_nan", HostSpace(), count, count,
                                  [values, count](Offset i) { return values[i] != values[i] ? i : count; });
    if (bad < count) throw Error("vertex " + std::to_string(bad) + " has no field value: it is NaN");
  }
}

/// Value and input id fit one key.
template <class Value>
void fill_keys(const Mesh& mesh, const Value* values, const Keys& keys) {
  const Id* const input = mesh.vertex_input().data();
  parallel_for("GALE::order_keys", HostSpace(), mesh.vertices(), [&](Offset v) {
    keys(v) = std::uint64_t(ordered_bits(values[input[v]])) << 32 | static_cast<std::uint32_t>(input[v]);
  });
}

/// Sorts the values by their keys in a space. May overwrite both.
template <class Space>
Array<const Id, HostMemory> sorted(const Space& space, const Keys& keys, const Array<Id, HostMemory>& values) {
  const auto sorted_keys = in_memory<MemoryOf<Space>>(keys);
  const auto sorted_values = in_memory<MemoryOf<Space>>(values);
  stable_sort_by_key(space, sorted_keys, sorted_values);
  return on_host(sorted_values);
}

/// The place of each value among all.
template <class Value>
void fill_ranks(const Mesh& mesh, const Value* values, const Keys& keys) {
  const Offset count = mesh.vertices();
  const auto inputs = allocate<Array<Id, HostMemory>>("GALE::order_inputs", count);
  parallel_for("GALE::order_bits", HostSpace(), count, [&](Offset i) {
    keys(i) = ordered_bits(values[i]);
    inputs(i) = static_cast<Id>(i);
  });
  const auto by_rank = in_worker_or_host_space(mesh, [&](const auto& space) { return sorted(space, keys, inputs); });
  const Id* const internal = mesh.vertex_internal().data();
  parallel_for("GALE::order_ranks", HostSpace(), count,
               [&](Offset rank) { keys(internal[by_rank(rank)]) = static_cast<std::uint64_t>(rank); });
}

}  // namespace

template <class Value>
VertexOrder::VertexOrder(const Mesh& mesh, const Value* values, std::size_t count)
    : mesh_(mesh), keys_(allocate<Keys>("GALE::order_keys", mesh.vertices())) {
  if (count != static_cast<std::size_t>(mesh.vertices())) {
    throw Error("the field has " + std::to_string(count) + " values, the mesh " + std::to_string(mesh.vertices()) +
                " vertices");
  }
  refuse_nan(values, mesh.vertices());
  if constexpr (sizeof(Value) == 8) {
    fill_ranks(mesh, values, keys_);
  } else {
    fill_keys(mesh, values, keys_);
  }
}

template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const char*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const signed char*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const unsigned char*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const short*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const unsigned short*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const int*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const unsigned int*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const long*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const unsigned long*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const long long*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const unsigned long long*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const float*, std::size_t);
template GALE_EXPORT VertexOrder::VertexOrder(const Mesh&, const double*, std::size_t);

}  // namespace gale
