#pragma once

#include <cstddef>
#include <cstdint>

#include <gale/io/cells/cells.hpp>

/// Cells of files that have points, lines and polygons by kinds.
namespace gale::io::detail {

/// Cells of one kind, unchecked.
struct CellsOfKind {
  PointArray::Values connectivity = std::vector<std::int32_t>();  ///< the points of each, one cell behind the other
  PointArray::Values ends = std::vector<std::int64_t>();          ///< where each ends there
};

/// The cells of a surface by their kinds, in the order in which VTK counts them.
struct SurfaceCells {
  std::size_t below = 0;  ///< how many points and lines there are, whose connectivity nobody reads
  CellsOfKind polygons, strips;
};

/// The cells of a surface as one list: points and lines first, which have no connectivity, then polygons and strips.
/// Polygons of three and four points are triangles and quads. A triangle that names a point twice counts as a line, as
/// polygons lose such triangles. Takes what is in `from`.
FileCells cells_of_surface(SurfaceCells from);

}  // namespace gale::io::detail
