#pragma once

#include <string>
#include <vector>

#include <gale/app/drawing/flat.hpp>

namespace gale::app {

/// A range of values along an axis of a plot.
struct Axis {
  double low, high;  ///< low < high, both finite; above 0 on a logarithmic axis
  bool is_logarithmic = false;
  std::string title;

  /// From 0 at `low` to 1 at `high`; what lies outside is brought to the nearer end.
  double along(double value) const;

  /// Where it has marks: powers of ten, or some five round values.
  std::vector<double> marks() const;
};

/// A number as a mark has it: at most six digits.
std::string mark_text(double value);

/// A frame with two axes, in pixels.
class Axes {
 public:
  Axes(const Axis& x, const Axis& y, Flat::Place low, Flat::Place high) : x_(x), y_(y), low_(low), high_(high) {}

  Flat::Place place(double x, double y) const;

  /// Adds the frame, marks, thin lines at these, and titles.
  void add_to(const std::string& title, Flat& flat) const;

 private:
  Axis x_, y_;
  Flat::Place low_, high_;
};

}  // namespace gale::app
