#pragma once

#include <memory>

#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale {

/// Four vertices per tetrahedron, in input ids, as a caller has them, in host memory or the producers'.
template <class Index, class Memory>
using Tetrahedra = Kokkos::View<const Index* [4], Kokkos::LayoutRight, Memory>;

/// A tetrahedral mesh, encoded once so that the relations of any segment can be computed from it alone (the paper's §4.3).
///
/// Any set of tetrahedra is a mesh: it may have several components, isolated vertices, parts that touch in an edge or a vertex
/// only, and triangles with three and more tetrahedra. GALE numbers vertices and tetrahedra anew (`EncodedMesh`); the permutations
/// lead back to input ids. Immutable after construction, so any number of threads may use it; copies share the arrays.
class Mesh {
 public:
  /// Encodes in the producers' space, in parallel, in time O(n). Peak memory beside the input: 20 bytes a tetrahedron and 4 an
  /// external one, and 16 a vertex.
  ///
  /// `Index` is std::int32_t or std::int64_t. Throws gale::Error, naming the tetrahedron at fault, where there is none, where one
  /// has a vertex outside 0..vertices-1 or the same twice, and where two have the same four.
  template <class Index, class Memory>
  Mesh(const Tetrahedra<Index, Memory>& tetrahedra, const Segmentation& segmentation);

  Id vertices() const;
  Id tetrahedra() const;
  Id segments() const;

  const EncodedMesh<ProducerMemory>& producer() const;

  /// The same arrays for the host's threads. With a device the first call copies them; any thread may make it.
  const EncodedMesh<HostMemory>& host() const;

  /// I_V on the host, at no cost.
  const Array<const Id, HostMemory>& vertex_begin() const;

  /// GALE's vertex -> input vertex, and back; the tetrahedra likewise. On the host; copied there at the first call.
  const Array<const Id, HostMemory>& vertex_input() const;
  const Array<const Id, HostMemory>& vertex_internal() const;
  const Array<const Id, HostMemory>& tetrahedron_input() const;

  /// vertex_input() in the producers' memory.
  const Array<const Id, ProducerMemory>& vertex_input_on_producer() const;

  /// The segment that holds a vertex (GALE's id): a binary search among the segments.
  Id segment_of(Id vertex) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace gale
