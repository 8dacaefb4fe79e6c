#pragma once

#include <array>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include <gale/app/drawing/scene.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

/// The 1-separatrices that a picture shows: those of each type along which the field changes most.
struct ShownPaths {
  /// The paths of one type, smoothed, without what another one shows already.
  struct Kind {
    std::vector<std::vector<Point>> stretches;
    Id inside = 0;  ///< how many paths come inside
    Id shown = 0;   ///< how many of these are shown
  };

  std::array<Kind, 3> kinds;          ///< by SeparatrixType: descending, connectors, ascending
  std::set<std::pair<int, Id>> ends;  ///< CellDimension and CellId of the critical simplices that they join

  /// Whether every path that comes inside is shown.
  bool are_all() const;
};

/// Chooses `most` of each type among the paths of `separatrices1` that have a line with both ends `inside`, and leaves
/// out all other lines. A path that is told as far as an earlier one goes on as that one does.
ShownPaths shown_paths(const io::Surface& separatrices1, Id most, const std::function<bool(const Point&)>& inside);

}  // namespace gale::app
