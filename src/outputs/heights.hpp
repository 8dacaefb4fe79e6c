#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/outputs/field.hpp>

namespace gale::outputs::detail {

/// Values of a field as an output has them: in float if that is the field's type, else in double.
inline io::PointArray::Values values_as(const io::PointArray& field, std::vector<double> values) {
  if (std::holds_alternative<std::vector<float>>(field.values)) return std::vector<float>(values.begin(), values.end());
  return values;
}

/// A field's values and order at input vertices. Refers to the field and to the gradient's arrays.
class Heights {
 public:
  Heights(const DiscreteGradient& gradient, const io::PointArray& field)
      : internal_(gradient.mesh().vertex_internal().data()), keys_(gradient.order().keys()), field_(field) {}

  double value(Id vertex) const { return value_at(field_, vertex); }

  /// The difference of two values; 0 where both are one infinity.
  static double difference(double high, double low) { return high == low ? 0 : high - low; }

  bool is_below(Id a, Id b) const { return keys_[internal_[a]] < keys_[internal_[b]]; }
  Id higher(Id a, Id b) const { return is_below(a, b) ? b : a; }
  Id lower(Id a, Id b) const { return is_below(a, b) ? a : b; }

 private:
  const Id* internal_;
  const std::uint64_t* keys_;
  const io::PointArray& field_;
};

}  // namespace gale::outputs::detail
