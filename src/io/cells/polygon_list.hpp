#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/surface_cells.hpp>

namespace gale::io::detail {

/// Polygons whose corners come one by one.
class PolygonList {
 public:
  /// Adds a corner to the polygon that is under way. What there is no such point is found when they are split.
  void add(std::int64_t point) {
    if (point < -1 || point > std::numeric_limits<std::int32_t>::max())
      damaged("corner ", corners_.size() - last_end(), " of polygon ", ends_.size(), " is ", point);
    corners_.push_back(static_cast<std::int32_t>(point));
  }

  /// Ends the polygon that is under way.
  void end() { ends_.push_back(static_cast<std::int64_t>(corners_.size())); }

  /// How many polygons have ended.
  std::size_t size() const { return ends_.size(); }

  /// Takes them all.
  CellsOfKind take() { return {std::move(corners_), std::move(ends_)}; }

 private:
  std::size_t last_end() const { return ends_.empty() ? 0 : static_cast<std::size_t>(ends_.back()); }

  std::vector<std::int32_t> corners_;
  std::vector<std::int64_t> ends_;
};

}  // namespace gale::io::detail
