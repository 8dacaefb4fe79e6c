// The adapter compiles where TTK's users' functions themselves are virtual, too.
#define TTK_ENABLE_KAMIKAZE
#define TTK_CELL_ARRAY_NEW
#include <gale/ttk/triangulation.hpp>

/// Makes the compiler see all of it.
int size_of_ttk_triangulation() {
  const gale::ttk::Triangulation mesh;
  return mesh.getNumberOfCells();
}
