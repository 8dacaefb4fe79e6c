#pragma once

#include <array>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/ttk/cells.hpp>
#include <gale/ttk/first_met.hpp>
#include <gale/ttk/packed_ids.hpp>

namespace gale::ttk {

/// TTK's numbers of edges or triangles: the order in which they are met first when one goes through the cells, and in
/// each cell through its edges or triangles as TTK lists them. So they depend on the caller's cells alone.
struct CellOrder {
  static constexpr Id crowded = -2;

  PackedIds number;  ///< GALE's id -> TTK's
  FirstMet met;      ///< TTK's id -> its first cell, and which of that cell's edges or triangles it is

  /// TTK's id of a facet (triangle of a tetrahedron, edge of a triangle) -> the second of its cells, ascending; no_id
  /// if there is one only, `crowded` if there are three or more.
  PackedIds second;
  bool any_crowded = false;

  bool is_there() const { return number.bytes() > 0; }
  Id count() const { return number.size(); }
  std::size_t bytes() const { return number.bytes() + met.bytes() + second.bytes(); }
};

/// Orders the edges (dimension 1) or triangles (2) of cells that have more dimensions. What isn't enumerated is.
/// `cells` are those that the mesh was made of. O(n), on all our threads; of facets 16 bytes each more meanwhile.
CellOrder order_of(int dimension, const Mesh& mesh, const Cells& cells);

/// The tables that are read on the host: edges and triangles by their vertices.
inline constexpr SimplexNeeds tables_of_edges = {Enumeration::edges, false, false, false};
inline constexpr SimplexNeeds tables_of_triangles = {Enumeration::triangles, false, false, false, false};

/// A cell's corners in GALE's ids, ascending, and where the caller has them.
struct SortedCorners {
  const int count;
  std::array<Id, 4> vertices;
  std::array<int, 4> places;

  SortedCorners(const Cells& cells, Id cell, const Id* vertex_internal) : count(cells.corners()) {
    for (int corner = 0; corner < count; ++corner) {
      const Id vertex = vertex_internal[cells.vertex(cell, corner)];
      int at = corner;
      for (; at > 0 && vertices[at - 1] > vertex; --at) {
        vertices[at] = vertices[at - 1];
        places[at] = places[at - 1];
      }
      vertices[at] = vertex;
      places[at] = corner;
    }
  }

  /// GALE's edges, or triangles, at their places; no_id where there is none.
  std::array<Id, 6> edges(const Simplices<HostMemory>& simplices) const {
    std::array<Id, 6> found;
    found.fill(no_id);
    for (int high = 1; high < count; ++high) {
      for (int low = 0; low < high; ++low) {
        found[place_of_corners[1 << places[low] | 1 << places[high]]] =
            simplices.edge_of(vertices[low], vertices[high]);
      }
    }
    return found;
  }
  std::array<Id, 4> triangles(const Simplices<HostMemory>& s) const {
    const auto [a, b, c, d] = vertices;
    const Id ab = s.edge_of(a, b);
    const Id without[4] = {s.triangle_of(s.edge_of(b, c), d), s.triangle_of(s.edge_of(a, c), d), s.triangle_of(ab, d),
                           s.triangle_of(ab, c)};
    std::array<Id, 4> found;
    for (int i = 0; i < 4; ++i) found[(places[i] + 1) % 4] = without[i];
    return found;
  }
};

}  // namespace gale::ttk
