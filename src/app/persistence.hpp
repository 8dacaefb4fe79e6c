#pragma once

#include <optional>
#include <string>

#include <gale/io/dataset.hpp>

namespace gale::app {

/// A threshold of persistence: a difference of the field's values, or a part of its range.
struct Persistence {
  double value = 0;
  bool is_percent = false;
};

/// "0.5" or "20%", at least 0. Throws UsageError, naming the option.
Persistence parse_persistence(const std::string& option, const std::string& text);

/// As a difference of values. Throws gale::Error for percents of a range that isn't finite.
double threshold_of(const Persistence& persistence, const io::PointArray& field);

}  // namespace gale::app
