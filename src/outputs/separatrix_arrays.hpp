#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gale/base/parallel.hpp>
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
std::vector<io::PointArray> separatrix_arrays(const std::vector<SeparatrixValues<Number>>& all,
                                              const io::PointArray& field, bool have_destinations) {
  const auto cells = [&all](const auto& value_of) {
    std::vector<std::decay_t<decltype(value_of(all[0]))>> values(all.empty() ? 0 : all.back().end);
    parallel_for("GALE::separatrix_arrays", HostExecutionSpace(), all.size(), [&](Offset i) {
      std::fill(values.begin() + (i == 0 ? 0 : all[i - 1].end), values.begin() + all[i].end, value_of(all[i]));
    });
    return values;
  };
  using Values = SeparatrixValues<Number>;
  std::vector<io::PointArray> arrays;
  arrays.push_back({"SourceId", 1, cells([](const Values& one) { return one.source; })});
  if (have_destinations)
    arrays.push_back({"DestinationId", 1, cells([](const Values& one) { return one.destination; })});
  arrays.push_back({"SeparatrixId", 1, cells([](const Values& one) { return one.id; })});
  arrays.push_back({"SeparatrixType", 1, cells([](const Values& one) { return one.type; })});
  const auto add_field = [&](const char* name, const auto& value_of) {
    arrays.push_back({name, 1, values_as(field, cells(value_of))});
  };
  add_field("SeparatrixFunctionMaximum", [](const Values& one) { return one.maximum; });
  add_field("SeparatrixFunctionMinimum", [](const Values& one) { return one.minimum; });
  add_field("SeparatrixFunctionDifference", [](const Values& one) {
    return one.maximum == one.minimum ? 0 : one.maximum - one.minimum;  // both may be one infinity
  });
  arrays.push_back(
      {"NumberOfCriticalPointsOnBoundary", 1, cells([](const Values& one) { return one.critical_on_surface; })});
  return arrays;
}

}  // namespace gale::outputs::detail
