#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gale/io/bytes/text.hpp>
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

/// Polygons whose corners come one by one.
class PolygonList {
 public:
  /// Adds a corner to the polygon that is under way. Points that don't exist are found when polygons are split.
  void add(std::int64_t point) {
    if (point < -1 || point > std::numeric_limits<std::int32_t>::max())
      damaged("corner ", corners_.size() - last_end(), " of polygon ", ends_.size(), " is ", point);
    corners_.push_back(static_cast<std::int32_t>(point));
  }

  /// Ends the polygon that is under way.
  void end() { ends_.push_back(static_cast<std::int64_t>(corners_.size())); }

  /// How many polygons have ended.
  std::size_t size() const { return ends_.size(); }

  /// Takes them all, as the cells of a surface that has nothing else.
  FileCells take() {
    SurfaceCells cells;
    cells.polygons = {std::move(corners_), std::move(ends_)};
    return cells_of_surface(std::move(cells));
  }

 private:
  std::size_t last_end() const { return ends_.empty() ? 0 : static_cast<std::size_t>(ends_.back()); }

  std::vector<std::int32_t> corners_;
  std::vector<std::int64_t> ends_;
};

}  // namespace gale::io::detail
