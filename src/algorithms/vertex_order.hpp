#pragma once

#include <cstdint>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// A total order of a mesh's vertices: by field value, then by input vertex id. Keys compare as the vertices do; they
/// lie on the host, under GALE's vertex ids, and no two are equal. It serves that mesh and its copies alone.
class GALE_EXPORT VertexOrder {
 public:
  /// From a value for each vertex, in input order; `Value` is `char`, any signed or unsigned integer type from
  /// `signed char` to `unsigned long long`, `float` or `double`. Infinities are values, and the two zeros are equal.
  /// Parallel; O(n) for types of up to 32 bits, else a sort. 8 bytes a vertex. Throws gale::Error if a value is NaN,
  /// naming the first such vertex, and if there aren't as many values as vertices.
  template <class Value>
  VertexOrder(const Mesh& mesh, const Value* values, std::size_t count);

  /// The same from a caller's View of rank 1, in host memory or the device's.
  template <class View, class = std::enable_if_t<Kokkos::is_view<View>::value>>
  VertexOrder(const Mesh& mesh, const View& values) : VertexOrder(of_view(mesh, values)) {}

  const Mesh& mesh() const { return mesh_; }
  const std::uint64_t* keys() const { return keys_.data(); }

 private:
  template <class View>
  static VertexOrder of_view(const Mesh& mesh, const View& values) {
    static_assert(View::rank == 1, "a value for each vertex");
    const auto there = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    if (there.span() == there.size()) return VertexOrder(mesh, there.data(), there.extent(0));
    const Array<typename View::non_const_value_type, HostMemory> copy("GALE::field", there.extent(0));
    Kokkos::deep_copy(copy, there);
    return VertexOrder(mesh, copy.data(), copy.extent(0));
  }

  Mesh mesh_;
  Array<std::uint64_t, HostMemory> keys_;
};

}  // namespace gale
