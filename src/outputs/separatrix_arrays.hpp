#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/types.hpp>
#include <gale/io/dataset.hpp>
#include <gale/outputs/heights.hpp>

namespace gale::outputs::detail {

/// What all cells (lines or polygons) of one separatrix carry. `Number` is Id, or GlobalId on several ranks.
template <class Number>
struct SeparatrixValues {
  Number source;     ///< CellId of the critical simplex where it begins
  Number id;         ///< its own number, from 0
  std::int8_t type;  ///< its kind, in TTK's codes
  double maximum;    ///< the field's
  double minimum;
  Id critical_on_surface;  ///< how many of the critical simplices that bound it are on the mesh's surface
};

/// The cell arrays that TTK gives both lines and walls.
template <class Number = Id>
class SeparatrixArrays {
 public:
  std::size_t cells() const { return sources_.size(); }

  void resize(std::size_t cells) {
    for (auto* const array : {&sources_, &ids_}) array->resize(cells);
    for (auto* const array : {&maxima_, &minima_, &differences_}) array->resize(cells);
    types_.resize(cells);
    on_surface_.resize(cells);
  }

  /// Gives the cells [begin, end) these values. Threads may set different cells at the same time.
  void set(std::size_t begin, std::size_t end, const SeparatrixValues<Number>& values) {
    const auto fill = [&](auto& array, auto value) { std::fill(array.begin() + begin, array.begin() + end, value); };
    fill(sources_, values.source);
    fill(ids_, values.id);
    fill(types_, values.type);
    fill(maxima_, values.maximum);
    fill(minima_, values.minimum);
    fill(differences_, Heights::difference(values.maximum, values.minimum));
    fill(on_surface_, values.critical_on_surface);
  }

  /// All of them, by name, in TTK's order; values of a float field in float, of all others in double.
  std::vector<io::PointArray> take(const io::PointArray& field) {
    return {{"SourceId", 1, std::move(sources_)},
            {"SeparatrixId", 1, std::move(ids_)},
            {"SeparatrixType", 1, std::move(types_)},
            {"SeparatrixFunctionMaximum", 1, values_as(field, std::move(maxima_))},
            {"SeparatrixFunctionMinimum", 1, values_as(field, std::move(minima_))},
            {"SeparatrixFunctionDifference", 1, values_as(field, std::move(differences_))},
            {"NumberOfCriticalPointsOnBoundary", 1, std::move(on_surface_)}};
  }

 private:
  std::vector<Number> sources_, ids_;
  std::vector<std::int8_t> types_;
  std::vector<double> maxima_, minima_, differences_;
  std::vector<Id> on_surface_;
};

}  // namespace gale::outputs::detail
