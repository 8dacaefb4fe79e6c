#include <algorithm>
#include <cmath>

#include <gale/base/error.hpp>
#include <gale/outputs/persistence.hpp>

namespace gale::outputs {

namespace {

/// Largest less smallest value.
double range_of(const io::PointArray& field) {
  return std::visit(
      [](const auto& values) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const auto value : values) {
          least = std::min(least, static_cast<double>(value));  // skips NaN: no comparison with it holds
          most = std::max(most, static_cast<double>(value));
        }
        return most - least;
      },
      field.values);
}

}  // namespace

double threshold_of(const Persistence& persistence, const io::PointArray& field) {
  if (!persistence.is_percent) return persistence.value;
  const double range = range_of(field);
  if (!std::isfinite(range))
    throw Error("there are no percents of the range of '" + field.name + "', which isn't finite");
  return persistence.value / 100 * range;
}

}  // namespace gale::outputs
