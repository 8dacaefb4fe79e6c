#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

namespace detail {

/// A value for each vertex, in input order, one after the other.
template <class Value, class Memory>
using FieldValues = Kokkos::View<const Value*, Kokkos::LayoutRight, Memory, Kokkos::MemoryUnmanaged>;

/// What a VertexOrder has of each vertex, by GALE's id.
struct OrderKeys {
  Mirrored<std::uint64_t> keys;  ///< compare on this rank

  /// Compare on all ranks, where there are several and values have 64 bits: keys are but ranks then. Else a key has its
  /// value in its upper half.
  Array<const std::uint64_t, HostMemory> values{};
};

/// Makes what a VertexOrder has.
template <class Value, class Memory>
GALE_EXPORT OrderKeys order_keys(const Mesh& mesh, const FieldValues<Value, Memory>& values);

/// Makes it of the places that vertices of a part have among those of all ranks, by input id.
GALE_EXPORT OrderKeys keys_of_places(const Mesh& mesh, const FieldValues<Id, HostMemory>& places);

}  // namespace detail

/// A total order of a mesh's vertices: by field value, then by input vertex id. Keys compare as the vertices do, under
/// GALE's vertex ids, and no two are equal. It serves that mesh and its copies alone. They are made where the mesh's
/// arrays are, a device or the host; the first call that wants them elsewhere copies them there.
///
/// On one rank's part of a mesh vertices compare as they do among all, then by global id. A field has a value for each
/// vertex that this rank has handed over, in that order; of a vertex that came from several ranks the lowest rank's
/// value counts. Making it is collective then: one exchange.
class GALE_EXPORT VertexOrder {
 public:
  /// From a value for each vertex, in input order; `Value` is `char`, any signed or unsigned integer type from
  /// `signed char` to `unsigned long long`, `float` or `double`. Infinities are values, and the two zeros are equal.
  /// Parallel; O(n) for types of up to 32 bits, else a sort. 8 bytes a vertex. Throws gale::Error if a value is NaN,
  /// naming the first such vertex, and if there aren't as many values as vertices: of a part on all ranks.
  template <class Value>
  VertexOrder(const Mesh& mesh, const Value* values, std::size_t count)
      : mesh_(mesh), all_(detail::order_keys(mesh, detail::FieldValues<Value, HostMemory>(values, count))) {}

  /// From a caller's View of rank 1, in host memory or the device's, as from an array. What wrote it must be done.
  template <class View, class = std::enable_if_t<Kokkos::is_view<View>::value>>
  VertexOrder(const Mesh& mesh, const View& values) : mesh_(mesh), all_(keys_of_view(mesh, values)) {}

  /// From the place of each vertex that this rank holds among those of all ranks, by input id: that is in no need of
  /// messages. Throws gale::Error if there aren't as many places as vertices.
  static VertexOrder of_places(const Mesh& mesh, const std::vector<Id>& places) {
    return VertexOrder(mesh,
                       detail::keys_of_places(mesh, detail::FieldValues<Id, HostMemory>(places.data(), places.size())));
  }

  /// The mesh whose vertices it orders.
  const Mesh& mesh() const { return mesh_; }

  /// The key of each vertex, by GALE's id, on the host. Throws OutOfMemory if they don't fit there.
  const std::uint64_t* keys() const { return all_.keys.in<HostMemory>().data(); }

  /// The keys where code that runs on `Memory` reads them. Throws OutOfMemory if they don't fit there.
  template <class Memory>
  const Array<const std::uint64_t, Memory>& keys_in() const {
    return all_.keys.in<Memory>();
  }

  /// Begins to bring the keys to the host, for algorithms that will ask for them there: keys() waits for that then.
  void bring_keys_to_host() const { all_.keys.bring_to_host(); }

  /// The keys of some vertices, by GALE's ids, read in the memory where all keys were made. For GALE's own algorithms.
  std::vector<std::uint64_t> keys_of(const std::vector<Id>& vertices) const;

  /// Whether values have 32 bits at most, so that keys have them in their upper halves. For GALE's own algorithms.
  bool has_short_values() const { return all_.values.extent(0) == 0; }

  /// A number for each vertex, by GALE's id, that compares as the field's values do on all ranks that the mesh lies on.
  /// For GALE's own algorithms.
  std::uint64_t value_key(Id vertex) const {
    return all_.values.extent(0) == 0 ? keys()[vertex] >> 32 : all_.values(vertex);
  }

  /// Value keys of some vertices (see value_key), read in the memory where all keys were made. For GALE's own
  /// algorithms.
  std::vector<std::uint64_t> value_keys_of(const std::vector<Id>& vertices) const;

  /// The highest of some vertices, by GALE's ids; no_id if there are none. Found where all keys were made.
  Id highest(Interval some) const;

 private:
  VertexOrder(const Mesh& mesh, detail::OrderKeys keys) : mesh_(mesh), all_(std::move(keys)) {}

  template <class View>
  static detail::OrderKeys keys_of_view(const Mesh& mesh, const View& view) {
    static_assert(View::rank == 1, "a value for each vertex");
    using Value = typename View::non_const_value_type;
    using Memory = std::conditional_t<is_device_memory<typename View::memory_space>, WorkerMemory, HostMemory>;
    if (view.span() == view.size())
      return detail::order_keys(mesh, detail::FieldValues<Value, Memory>(view.data(), view.extent(0)));
    const Kokkos::View<Value*, Kokkos::LayoutRight, Memory> copy("GALE::field", view.extent(0));
    Kokkos::deep_copy(copy, view);
    return detail::order_keys(mesh, detail::FieldValues<Value, Memory>(copy));
  }

  Mesh mesh_;
  detail::OrderKeys all_;
};

}  // namespace gale
