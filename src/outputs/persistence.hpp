#pragma once

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// A threshold of persistence: a difference of the field's values, or a part of the field's range.
struct Persistence {
  double value = 0;         ///< at least 0
  bool is_percent = false;  ///< whether `value` is in percent of the range
};

/// The threshold as a difference of values: what `simplify` takes. NaN is no part of the range. Throws gale::Error,
/// with the field's name, for percents of a range that isn't finite.
GALE_EXPORT double threshold_of(const Persistence& persistence, const io::PointArray& field);

}  // namespace gale::outputs
