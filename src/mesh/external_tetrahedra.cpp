#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>
#include <gale/mesh/encode.hpp>

namespace gale::detail {

namespace {

using Ids = Array<Id, WorkerMemory>;
using Offsets = Array<Offset, WorkerMemory>;

Ids segment_of_vertices(const EncodedMesh<WorkerMemory>& mesh, Offset vertices) {
  const auto segment_of = allocate<Ids>("GALE::segment_of", vertices);
  const auto begin = mesh.vertex_begin;
  const auto segments = static_cast<Id>(begin.extent(0)) - 1;
  parallel_for(
      "GALE::segment_of", WorkerSpace(), vertices, KOKKOS_LAMBDA(Offset v) {
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

/// Calls `visit(s)` for each segment s that tetrahedron t touches beside the one it is internal to. A tetrahedron's
/// vertices ascend, and so do their segments.
template <class Visit>
KOKKOS_FUNCTION void for_each_external_segment(const EncodedMesh<WorkerMemory>& mesh, const Ids& segment_of, Offset t,
                                               const Visit& visit) {
  Id previous = segment_of(mesh.tetrahedra(t, 0));
  if (mesh.tetrahedra(t, 3) < mesh.vertex_begin(previous + 1)) return;
  for (int corner = 1; corner < 4; ++corner) {
    const Id here = segment_of(mesh.tetrahedra(t, corner));
    if (here != previous) visit(here);
    previous = here;
  }
}

}  // namespace

void find_external_tetrahedra(MeshArrays<WorkerMemory>& result, Id vertices) {
  const EncodedMesh<WorkerMemory> mesh = result.view();
  const WorkerSpace space;
  const Offset segments = mesh.vertex_begin.extent(0) - 1;
  const Offset tetrahedra = mesh.tetrahedra.extent(0);
  const auto segment_of = segment_of_vertices(mesh, vertices);
  const Offsets begin("GALE::external_begin", segments + 1);
  parallel_for(
      "GALE::count_external", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
        for_each_external_segment(mesh, segment_of, t, [&](Id s) { atomic_add(&begin(s), Offset(1)); });
      });
  const Offset total = exclusive_scan(
      "GALE::scan_external", space, segments, begin, KOKKOS_LAMBDA(Offset s) { return begin(s); });
  const auto next = allocate<Offsets>("GALE::external_next", segments);
  parallel_for(
      "GALE::external_next", space, segments, KOKKOS_LAMBDA(Offset s) { next(s) = begin(s); });
  const auto external = allocate<Ids>("GALE::external", total);
  parallel_for(
      "GALE::fill_external", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
        for_each_external_segment(mesh, segment_of, t,
                                  [&](Id s) { external(atomic_add(&next(s), Offset(1))) = static_cast<Id>(t); });
      });
  sort_rows("GALE::sort_external", begin, external);
  result.external_begin = begin;
  result.external = external;
}

}  // namespace gale::detail
