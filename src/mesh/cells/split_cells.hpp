#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/cells/cell_types.hpp>

// Cells of all kinds as simplices, so that neighbours fit.

namespace gale {

/// Cells as VTK has them, in host memory or the workers'. `Index` is std::int32_t or std::int64_t.
template <class Index, class Memory>
struct Cells {
  Array<const std::uint8_t, Memory> types;  ///< VTK's number of each cell
  Array<const Offset, Memory> offsets;      ///< where each begins in `connectivity`, and the end of the last

  /// The cells' points, in VTK's order. A polyhedron has its faces there: how many they are, then of each how many
  /// corners it has, and these.
  Array<const Index, Memory> connectivity;
};

/// What cells were split into.
template <int Corners, class Memory>
struct SplitCells {
  Kokkos::View<Id* [Corners], Kokkos::LayoutRight, Memory> simplices;  ///< vertices of each, those of a cell together
  Array<Id, Memory> cells;  ///< the cell that each is, or is of, ascending; empty where all cells are simplices
  std::vector<std::string> notices;  ///< a line each on what was split and what was left out
};

/// Splits cells into tetrahedra, without new points: each face that isn't a triangle is cut as a fan from its lowest
/// vertex, and each cell is the cone from its lowest vertex over the triangles of those faces that don't touch it. So
/// cells that share a face cut it alike, whatever their order.
///
/// Takes tetrahedra, which stay as they are, hexahedra, voxels, wedges, pyramids, pentagonal and hexagonal prisms,
/// polyhedra, and quadratic tetrahedra: eight linear ones each, over their middle points. Cells that name a vertex
/// twice lose the tetrahedra that do. Cells of lower dimension are left out.
///
/// Vertices are 0 to points-1. The lowest is that of the lowest of `ids`, one for each point, all different; without
/// those, that of the lowest number. Runs where the cells are, in parallel. Time O(entries); memory 16 bytes a
/// tetrahedron, 4 more where any cell is none, and 8 a cell meanwhile.
///
/// Throws gale::Error, naming the cell at fault: a type that is unknown or isn't split (those of higher order), offsets
/// that decrease or exceed the connectivity, a number of points that the type hasn't got, a point that there is not,
/// faces of a polyhedron that have fewer than three corners or don't close. And for more than 2^31 - 1 tetrahedra.
template <class Index, class Memory>
GALE_EXPORT SplitCells<4, Memory> split_cells(const Cells<Index, Memory>& cells, Offset points,
                                              const Array<const GlobalId, Memory>& ids = {});

/// Splits cells into triangles in the same manner: triangles, quads, pixels, polygons, triangle strips, and quadratic
/// triangles, four each.
template <class Index, class Memory>
GALE_EXPORT SplitCells<3, Memory> split_polygons(const Cells<Index, Memory>& cells, Offset points,
                                                 const Array<const GlobalId, Memory>& ids = {});

/// The notices about cells that were split into so many simplices of so many corners, and about those left out: `cells`
/// are how many there are of each type, by VTK's number. What split_cells() says by itself; for several ranks together.
GALE_EXPORT std::vector<std::string> notices_of_split(const std::array<Offset, 256>& cells, Offset simplices,
                                                      int corners);

/// Whether all cells are tetrahedra, whose corners follow each other in the connectivity.
template <class Index, class Memory>
GALE_EXPORT bool are_tetrahedra(const Cells<Index, Memory>& cells);

/// "12 hexahedra and 3 wedges": the cells of dimension 3 that aren't tetrahedra, or those of dimension 2 that aren't
/// triangles; empty where there are none.
GALE_EXPORT std::string other_cells(const Array<const std::uint8_t, HostMemory>& types, int dimension = 3);

/// The highest dimension of cells that have one of these types, by VTK's number; 0 where none is known.
GALE_EXPORT int highest_dimension(const Array<const std::uint8_t, HostMemory>& types);

/// The highest dimension of so many cells of each type; 0 where none is known.
GALE_EXPORT int highest_dimension(const std::array<Offset, 256>& cells);

}  // namespace gale
