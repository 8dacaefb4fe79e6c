#include <gale/base/group_by.hpp>
#include <gale/base/sort_rows.hpp>
#include <gale/mesh/encode.hpp>

namespace gale::detail {

namespace {

template <class Space>
Array<Id, MemoryOf<Space>> segment_of_vertices(const Space& space, const EncodedMesh<MemoryOf<Space>>& mesh,
                                               Offset vertices) {
  const auto segment_of = allocate<Array<Id, MemoryOf<Space>>>("GALE::segment_of", vertices);
  const auto begin = mesh.vertex_begin;
  const auto segments = static_cast<Id>(begin.extent(0)) - 1;
  parallel_for(
      "GALE::segment_of", space, vertices, KOKKOS_LAMBDA(Offset v) {
        Id low = 0, high = segments - 1;
        while (low < high) {
          const Id middle = low + (high - low + 1) / 2;
          if (begin(middle) <= v) {
            low = middle;
          } else {
            high = middle - 1;
          }
        }
        segment_of(v) = low;
      });
  return segment_of;
}

/// The segments that a tetrahedron touches beside the one it is internal to. Its vertices ascend, and so do their
/// segments.
template <class Memory>
struct ExternalSegments {
  EncodedMesh<Memory> mesh;
  Kokkos::View<const Id*, Memory, Kokkos::MemoryUnmanaged> segment_of;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    Id previous = segment_of(mesh.tetrahedra(t, 0));
    if (mesh.tetrahedra(t, 3) < mesh.vertex_begin(previous + 1)) return;
    for (int corner = 1; corner < 4; ++corner) {
      const Id here = segment_of(mesh.tetrahedra(t, corner));
      if (here != previous) visit(here);
      previous = here;
    }
  }
};

}  // namespace

template <class Space>
ExternalTetrahedra<MemoryOf<Space>> find_external_tetrahedra(const Space& space,
                                                             const EncodedMesh<MemoryOf<Space>>& mesh, Id vertices) {
  const auto segment_of = segment_of_vertices(space, mesh, vertices);
  const auto groups = group_by("GALE::external", space, mesh.tetrahedra.extent(0), mesh.vertex_begin.extent(0) - 1,
                               ExternalSegments<MemoryOf<Space>>{mesh, segment_of});
  sort_rows(space, "GALE::sort_external", groups.begin, groups.members);
  return {groups.begin, groups.members};
}

#define GALE_INSTANTIATE(Space)                                                       \
  template ExternalTetrahedra<MemoryOf<Space>> find_external_tetrahedra(const Space&, \
                                                                        const EncodedMesh<MemoryOf<Space>>&, Id)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
