#pragma once

#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/separatrix_arrays.hpp>

namespace gale::outputs::detail {

/// What 1-separatrices are in a file: points, two for each cell of a path, and lines between those that follow one
/// another on it. `Number` is Id, or GlobalId on several ranks.
template <class Coordinate, class Number = Id>
class LineArrays {
 public:
  /// Arrays for that many cells on so many paths. Throws gale::Error if that is more than ids can number.
  LineArrays(Offset cells, Offset paths) {
    require_ids("points of 1-separatrices", 2 * cells);
    const Offset lines = 2 * cells - paths;
    positions_ = allocate<io::Dataset::Points<Coordinate>>("GALE::separatrices", 2 * cells);
    for (auto* const array : {&mask_, &dimensions_}) array->resize(2 * cells);
    ids_.resize(2 * cells);
    lines_.begin.resize(lines + 1);
    lines_.points.resize(2 * lines);
    destinations_.resize(lines);
    of_lines_.resize(lines);
  }

  /// Threads may set different points and lines at the same time.
  void set_point(Offset place, const gale::detail::Point& at, Number id, int dimension, bool is_end) {
    gale::detail::store(at, positions_, place);
    mask_[place] = is_end ? 0 : 1;
    dimensions_[place] = static_cast<std::int8_t>(dimension);
    ids_[place] = id;
  }

  /// Gives a path its lines: `count` of them from `first` on, between points that follow one another from `point` on.
  void set_lines(Offset first, Offset count, Offset point, Number destination, const SeparatrixValues<Number>& values) {
    for (Offset i = 0; i < count; ++i) {
      const Offset line = first + i;
      lines_.begin[line + 1] = 2 * (line + 1);
      lines_.points[2 * line] = static_cast<Id>(point + i);
      lines_.points[2 * line + 1] = static_cast<Id>(point + i + 1);
      destinations_[line] = destination;
    }
    of_lines_.set(first, first + count, values);
  }

  Number id(Offset point) const { return ids_[point]; }

  io::Surface take(const io::PointArray& field) {
    io::Surface surface;
    surface.points = positions_;
    surface.point_arrays = {{"ttkMaskScalarField", 1, std::move(mask_)},
                            {"CellDimension", 1, std::move(dimensions_)},
                            {"CellId", 1, std::move(ids_)}};
    surface.lines = std::move(lines_);
    surface.cell_arrays = of_lines_.take(field);
    surface.cell_arrays.insert(surface.cell_arrays.begin() + 1, {"DestinationId", 1, std::move(destinations_)});
    return surface;
  }

 private:
  io::Dataset::Points<Coordinate> positions_;
  std::vector<std::int8_t> mask_, dimensions_;
  std::vector<Number> ids_, destinations_;
  io::Surface::Cells lines_;
  SeparatrixArrays<Number> of_lines_;
};

}  // namespace gale::outputs::detail
