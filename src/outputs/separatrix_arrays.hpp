#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <gale/outputs/values.hpp>

namespace gale::outputs::detail {

/// What all cells (lines or polygons) of one separatrix carry. `Number` is Id, or GlobalId on several ranks.
template <class Number>
struct SeparatrixValues {
  Offset end;          ///< one past its last cell; it begins where the one before ends
  Number source;       ///< CellId of the critical simplex where it begins
  Number destination;  ///< CellId of the one where it ends, for lines
  Number id;           ///< its own number, from 0
  std::int8_t type;    ///< its kind, in TTK's codes
  double maximum;      ///< the field's
  double minimum;
  Id critical_on_surface;  ///< how many of the critical simplices that bound it are on the mesh's surface
};

/// The cell arrays that TTK gives separatrices, by name, in TTK's order; values of a float field in float, of all
/// others in double.
template <class Number>
class SeparatrixArrays {
 public:
  /// Arrays of so many cells.
  explicit SeparatrixArrays(std::size_t cells)
      : source_(cells),
        destination_(cells),
        id_(cells),
        type_(cells),
        maximum_(cells),
        minimum_(cells),
        difference_(cells),
        critical_on_surface_(cells) {}

  /// Sets what the cells of one have, from `begin` on. Any number of threads may.
  void set(Offset begin, const SeparatrixValues<Number>& one) {
    for (Offset cell = begin; cell < one.end; ++cell) {
      source_[cell] = one.source;
      destination_[cell] = one.destination;
      id_[cell] = one.id;
      type_[cell] = one.type;
      maximum_[cell] = one.maximum;
      minimum_[cell] = one.minimum;
      difference_[cell] = one.maximum == one.minimum ? 0 : one.maximum - one.minimum;  // both may be one infinity
      critical_on_surface_[cell] = one.critical_on_surface;
    }
  }

  std::vector<io::PointArray> take(const io::PointArray& field, bool have_destinations) {
    std::vector<io::PointArray> arrays;
    const auto add = [&](const char* name, auto&& values) { arrays.push_back({name, 1, std::move(values)}); };
    add("SourceId", source_);
    if (have_destinations) add("DestinationId", destination_);
    add("SeparatrixId", id_);
    add("SeparatrixType", type_);
    add("SeparatrixFunctionMaximum", values_as(field, std::move(maximum_)));
    add("SeparatrixFunctionMinimum", values_as(field, std::move(minimum_)));
    add("SeparatrixFunctionDifference", values_as(field, std::move(difference_)));
    add("NumberOfCriticalPointsOnBoundary", critical_on_surface_);
    return arrays;
  }

 private:
  std::vector<Number> source_, destination_, id_;
  std::vector<std::int8_t> type_;
  std::vector<double> maximum_, minimum_, difference_;
  std::vector<Id> critical_on_surface_;
};

}  // namespace gale::outputs::detail
