#pragma once

#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// A field at input vertices, and its order. Refers to what it is made from.
class Heights {
 public:
  Heights(const Mesh& mesh, const VertexOrder& order, const io::PointArray& field)
      : internal_(mesh.vertex_internal().data()), order_(order), field_(field) {}

  double value(Id vertex) const {
    return std::visit([vertex](const auto& values) { return static_cast<double>(values[vertex]); }, field_.values);
  }

  /// Of two values, 0 where they are the same infinity.
  static double difference(double high, double low) { return high == low ? 0 : high - low; }

  bool is_below(Id a, Id b) const { return order_.keys()[internal_[a]] < order_.keys()[internal_[b]]; }
  Id higher(Id a, Id b) const { return is_below(a, b) ? b : a; }
  Id lower(Id a, Id b) const { return is_below(a, b) ? a : b; }

 private:
  const Id* internal_;
  const VertexOrder& order_;
  const io::PointArray& field_;
};

}  // namespace gale::outputs
