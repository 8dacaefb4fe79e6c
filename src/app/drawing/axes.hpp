#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gale/app/console.hpp>
#include <gale/app/drawing/scene.hpp>

namespace gale::app {

/// A range of values along an axis of a plot.
struct Axis {
  double low, high;  ///< low < high, both finite; above 0 on a logarithmic axis
  bool is_logarithmic = false;
  std::string title{};  ///< an axis without one has no marks

  /// From 0 at `low` to 1 at `high`; what lies outside is brought to the nearer end.
  double along(double value) const {
    const auto scaled = [this](double at) { return is_logarithmic ? std::log10(at) : at; };
    const double inside = std::clamp(value, low, high);
    return (scaled(inside) - scaled(low)) / (scaled(high) - scaled(low));
  }

  /// Where it has marks: powers of ten, or some five round values.
  std::vector<double> marks() const {
    std::vector<double> marks;
    if (title.empty()) return marks;
    if (is_logarithmic) {
      const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
      const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
      const int step = (last - first) / 8 + 1;
      for (int power = first; power <= last; power += step) marks.push_back(std::pow(10.0, power));
      return marks;
    }
    const double rough = (high - low) / 5, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
    const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
    for (double k = first; k <= last && marks.size() < 20; ++k) marks.push_back(k * step + 0.0);  // never -0
    return marks;
  }
};

/// A frame with two axes, in pixels.
class Axes {
 public:
  Axes(const Axis& x, const Axis& y, Flat::Place low, Flat::Place high) : x_(x), y_(y), low_(low), high_(high) {}

  Flat::Place place(double x, double y) const {
    return {low_[0] + x_.along(x) * (high_[0] - low_[0]), low_[1] + y_.along(y) * (high_[1] - low_[1])};
  }

  /// Adds the frame, marks, thin lines at these, and titles.
  void add_to(const std::string& title, Flat& flat) const {
    constexpr Color pale{225, 225, 225}, dark{90, 90, 90};
    const auto mark = [](double value) { return formatted("%.6g", value); };
    Flat::Lines grid{pale, 1, 1, {}};
    for (const double x : x_.marks()) {
      const Flat::Place foot = place(x, y_.low);
      grid.paths.push_back({foot, {foot[0], high_[1]}});
      flat.texts.push_back({mark(x), {foot[0], low_[1] - 14}});
    }
    for (const double y : y_.marks()) {
      const Flat::Place foot = place(x_.low, y);
      grid.paths.push_back({foot, {high_[0], foot[1]}});
      flat.texts.push_back({mark(y), {low_[0] - 8, foot[1]}, Flat::Text::Anchor::right});
    }
    flat.lines.push_back(grid);
    flat.lines.push_back({dark, 1.5, 1, {{low_, {high_[0], low_[1]}, high_, {low_[0], high_[1]}, low_}}});
    const double middle_x = (low_[0] + high_[0]) / 2, middle_y = (low_[1] + high_[1]) / 2;
    flat.texts.push_back({title, {middle_x, high_[1] + 18}, Flat::Text::Anchor::middle, 16});
    if (!x_.title.empty()) flat.texts.push_back({x_.title, {middle_x, low_[1] - 38}});
    flat.texts.push_back({y_.title, {low_[0] - 66, middle_y}, Flat::Text::Anchor::middle, 14, true});
  }

 private:
  Axis x_, y_;
  Flat::Place low_, high_;
};

}  // namespace gale::app
