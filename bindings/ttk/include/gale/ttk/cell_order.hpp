#pragma once

#include <cstdint>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

/// TTK's numbers of edges or triangles: the order in which they are met first when one goes through the cells, and in
/// each cell through its edges or triangles as TTK lists them. So they depend on the caller's cells alone.
struct CellOrder {
  Array<Id, HostMemory> number;    ///< GALE's id -> TTK's
  Array<Id, HostMemory> internal;  ///< TTK's id -> GALE's
};

/// Of the edges; enumerates them if they haven't been. `cells` are those that the mesh was made of. O(n), on all our
/// threads; 5 bytes a cell beside the result meanwhile.
CellOrder order_of_edges(const Mesh& mesh, const Cells& cells);

/// Likewise of the triangles. `tetrahedra` receives how many tetrahedra each (TTK's id) has: 1, 2, or 3 for more.
CellOrder order_of_triangles(const Mesh& mesh, const Cells& cells, Array<std::uint8_t, HostMemory>& tetrahedra);

}  // namespace gale::ttk
