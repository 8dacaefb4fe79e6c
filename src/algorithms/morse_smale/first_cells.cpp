#include <gale/algorithms/morse_smale/first_cells.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/grid/grid_view.hpp>

namespace gale::detail {

namespace {

/// What first_cells does of a grid, where each vertex knows its cells.
template <class Space>
void first_cells_of_grid(const Space& space, const Mesh& mesh, const Array<Id, MemoryOf<Space>>& first) {
  const GridView grid = mesh.grid()->in<MemoryOf<Space>>();
  const StarKind* const kinds = mesh.grid()->kinds_in<MemoryOf<Space>>();
  const Id* const begin = mesh.interval_begin<MemoryOf<Space>>(0).data();
  parallel_for(
      "GALE::first_cells", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        GridCursor at(grid);
        for (Id v = begin[s]; v < begin[s + 1]; ++v) {
          at.go_to(v);
          first(v) = at.cell(kinds[at.kind()].cell[0]);
        }
      });
}

}  // namespace

template <class Space>
Array<Id, MemoryOf<Space>> first_cells(const Space& space, const Mesh& mesh) {
  const auto first = allocate<Array<Id, MemoryOf<Space>>>("GALE::first_cells", mesh.vertices());
  if (mesh.grid() != nullptr) {
    first_cells_of_grid(space, mesh, first);
    return first;
  }
  const auto encoded = mesh.encoded<MemoryOf<Space>>();
  const auto input = mesh.cell_input<MemoryOf<Space>>();
  parallel_for(
      "GALE::first_cells", space, mesh.segments(), KOKKOS_LAMBDA(Offset s) {
        const Id begin = encoded.vertex_begin(s), end = encoded.vertex_begin(s + 1);
        const auto offer = [&](Id t) {
          for (int corner = 0; corner < 4; ++corner) {
            const Id v = encoded.cells(t, corner);
            if (v >= begin && v < end && (first(v) == no_id || input(t) < input(first(v)))) first(v) = t;
          }
        };
        for (Id v = begin; v < end; ++v) first(v) = no_id;
        for (Id t = encoded.internal_begin(s); t < encoded.internal_begin(s + 1); ++t) offer(t);
        for (Offset i = encoded.external_begin(s); i < encoded.external_begin(s + 1); ++i) offer(encoded.external(i));
      });
  return first;
}

#define GALE_INSTANTIATE(Space) template Array<Id, MemoryOf<Space>> first_cells<Space>(const Space&, const Mesh&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
