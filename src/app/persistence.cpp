#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gale/app/options.hpp>
#include <gale/app/persistence.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

namespace {

/// Largest less smallest value.
double range_of(const io::PointArray& field) {
  return std::visit(
      [](const auto& values) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const auto value : values) {
          least = std::min(least, static_cast<double>(value));  // NaN, which an order may come with, never is
          most = std::max(most, static_cast<double>(value));
        }
        return most - least;
      },
      field.values);
}

}  // namespace

Persistence parse_persistence(const std::string& option, const std::string& text) {
  Persistence persistence;
  persistence.is_percent = !text.empty() && text.back() == '%';
  const std::string number = persistence.is_percent ? text.substr(0, text.size() - 1) : text;
  char* end = nullptr;
  persistence.value = std::strtod(number.c_str(), &end);
  const bool is_number =
      !number.empty() && number.find_first_not_of("0123456789.eE+-") == std::string::npos && *end == '\0';
  if (is_number && std::isfinite(persistence.value) && persistence.value >= 0) return persistence;
  throw UsageError(option + ": '" + text +
                   "' is no difference of values of at least 0, such as 0.5, nor a part of their range, such as 20%");
}

double threshold_of(const Persistence& persistence, const io::PointArray& field) {
  if (!persistence.is_percent) return persistence.value;
  const double range = range_of(field);
  if (!std::isfinite(range))
    throw Error("--persistence: there are no percents of the range of '" + field.name + "', which isn't finite");
  return persistence.value / 100 * range;
}

}  // namespace gale::app
