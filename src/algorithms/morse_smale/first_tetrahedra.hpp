#pragma once

#include <cstdint>

#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

inline constexpr std::uint64_t no_first = ~std::uint64_t(0);

/// Finds those of a segment's vertices.
template <class Memory>
struct FindFirstTetrahedra {
  EncodedMesh<Memory> mesh;
  Array<const Id, Memory> input;
  Array<std::uint64_t, Memory> first;

  KOKKOS_FUNCTION void operator()(Offset s) const {
    const Id begin = mesh.vertex_begin(s), end = mesh.vertex_begin(s + 1);
    for (Id v = begin; v < end; ++v) first(v) = no_first;
    for (Id t = mesh.internal_begin(s); t < mesh.internal_begin(s + 1); ++t) offer(t, begin, end);
    for (Offset i = mesh.external_begin(s); i < mesh.external_begin(s + 1); ++i) offer(mesh.external(i), begin, end);
  }

 private:
  KOKKOS_FUNCTION void offer(Id t, Id begin, Id end) const {
    const std::uint64_t key = pair_key(input(t), t);
    for (int corner = 0; corner < 4; ++corner) {
      const Id v = mesh.tetrahedra(t, corner);
      if (v >= begin && v < end && key < first(v)) first(v) = key;
    }
  }
};

/// For each vertex (GALE's id) its tetrahedron of lowest input id, with that id in the upper half; `no_first` where it
/// has no tetrahedron.
template <class Space>
Array<std::uint64_t, MemoryOf<Space>> first_tetrahedra(const Space& space, const Mesh& mesh) {
  const auto first = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::first_tetrahedra", mesh.vertices());
  const FindFirstTetrahedra<MemoryOf<Space>> find{mesh.encoded<MemoryOf<Space>>(),
                                                  mesh.tetrahedron_input<MemoryOf<Space>>(), first};
  parallel_for("GALE::first_tetrahedra", space, mesh.segments(), find);
  return first;
}

}  // namespace gale::detail
