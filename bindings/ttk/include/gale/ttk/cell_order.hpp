#pragma once

#include <cstdint>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

/// TTK's numbers of edges or triangles: the order in which they are met first when one goes through the cells, and in
/// each cell through its edges or triangles as TTK lists them. So they depend on the caller's cells alone.
struct CellOrder {
  Array<Id, HostMemory> number;           ///< GALE's id -> TTK's
  Array<Id, HostMemory> first_cells;      ///< TTK's id -> the first cell that has it; every `stride`-th entry
  Array<std::uint8_t, HostMemory> fresh;  ///< by cell: those of its edges or triangles that it is the first to have
  int stride = 1;

  bool is_there() const { return number.data() != nullptr; }
  Id count() const { return static_cast<Id>(number.extent(0)); }
  Id first_cell(Id simplex) const { return first_cells.data()[Offset(stride) * simplex]; }

  /// Which of its first cell's edges or triangles it is, as TTK lists them.
  int place(Id simplex) const {
    const Id cell = first_cell(simplex);
    unsigned left = fresh.data()[cell];
    while (simplex-- > 0 && first_cell(simplex) == cell) left &= left - 1;
    return __builtin_ctz(left);
  }
};

/// Of the edges; enumerates them if they haven't been. `cells` are those that the mesh was made of. O(n), on all our
/// threads; 4 bytes a cell beside the result meanwhile.
CellOrder order_of_edges(const Mesh& mesh, const Cells& cells);

/// Likewise of the triangles, with their stars; 8 bytes a triangle more meanwhile.
struct TriangleOrder : CellOrder {
  static constexpr Id crowded = -2;

  /// The cells of a triangle, ascending: the second is no_id if there is one only, `crowded` if there are three or
  /// more.
  const Id* star(Id triangle) const { return first_cells.data() + Offset(2) * triangle; }

  bool any_crowded = false;
};

TriangleOrder order_of_triangles(const Mesh& mesh, const Cells& cells);

}  // namespace gale::ttk
