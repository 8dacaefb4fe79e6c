#pragma once

#include <cstdint>

#include <gale/mesh/mesh.hpp>

namespace gale {

/// A total order of a mesh' vertices: by field value, then by input vertex id. Keys compare as the vertices do; they lie on the host,
/// under GALE's vertex ids, and no two are equal.
class VertexOrder {
 public:
  /// From a value for each vertex, in input order; `Value` is any of the ten fixed-size integers and floating-point types. Infinities are
  /// values, and the two zeros are equal. Parallel; O(n) for types of up to 32 bits, else a sort. 8 bytes a vertex.
  /// Throws gale::Error if a value is NaN, naming the first such vertex, and if there aren't as many values as vertices.
  template <class Value>
  VertexOrder(const Mesh& mesh, const Value* values, std::size_t count);

  const std::uint64_t* keys() const { return keys_.data(); }

 private:
  Array<std::uint64_t, HostMemory> keys_;
};

}  // namespace gale
