#pragma once

#include <cstdint>

#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

inline constexpr std::uint64_t no_first = ~std::uint64_t(0);

/// For each vertex (GALE's id) its tetrahedron of lowest input id, with that id in the upper half; `no_first` where it
/// has no tetrahedron.
template <class Space>
Array<std::uint64_t, MemoryOf<Space>> first_tetrahedra(const Space& space, const Mesh& mesh) {
  const auto first = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::first_tetrahedra", mesh.vertices());
  const auto encoded = mesh.encoded<MemoryOf<Space>>();
  const auto input = mesh.tetrahedron_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::first_tetrahedra", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        const Id begin = encoded.vertex_begin(s), end = encoded.vertex_begin(s + 1);
        for (Id v = begin; v < end; ++v) first(v) = no_first;
        const auto offer = [&](Id t) {
          const std::uint64_t key = pair_key(input(t), t);
          for (int corner = 0; corner < 4; ++corner) {
            const Id v = encoded.tetrahedra(t, corner);
            if (v >= begin && v < end && key < first(v)) first(v) = key;
          }
        };
        for (Id t = encoded.internal_begin(s); t < encoded.internal_begin(s + 1); ++t) offer(t);
        for (Offset i = encoded.external_begin(s); i < encoded.external_begin(s + 1); ++i) offer(encoded.external(i));
      });
  return first;
}

}  // namespace gale::detail
