#include <gale/ttk/connectivity.hpp>

/// One tetrahedron: what stands behind the triangulation for TTK, which needs TTK's header itself.
int main() {
  const Kokkos::ScopeGuard kokkos(gale::initialization_arguments(1));
  const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const long long cells[] = {0, 1, 2, 3};
  gale::ttk::Connectivity mesh({points, 4, false}, gale::ttk::Cells(cells, 4, 4, 1), {});
  mesh.need_rows(gale::Relation::VV);
  return mesh.row<gale::Relation::VV>(2).size() == 3 ? 0 : 1;
}
