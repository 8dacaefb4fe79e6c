#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gale/app/drawing/axes.hpp>

namespace gale::app {

double Axis::along(double value) const {
  const auto scaled = [this](double at) { return is_logarithmic ? std::log10(at) : at; };
  const double inside = std::clamp(value, low, high);
  return (scaled(inside) - scaled(low)) / (scaled(high) - scaled(low));
}

std::vector<double> Axis::marks() const {
  std::vector<double> marks;
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
  for (double k = first; k <= last && marks.size() < 20; ++k) marks.push_back(k * step);
  return marks;
}

std::string mark_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

Flat::Place Axes::place(double x, double y) const {
  return {low_[0] + x_.along(x) * (high_[0] - low_[0]), low_[1] + y_.along(y) * (high_[1] - low_[1])};
}

void Axes::add_to(const std::string& title, Flat& flat) const {
  constexpr Color pale{225, 225, 225}, dark{90, 90, 90};
  Flat::Lines grid{pale, 1, 1, {}};
  for (const double x : x_.marks()) {
    const Flat::Place foot = place(x, y_.low);
    grid.paths.push_back({foot, {foot[0], high_[1]}});
    flat.texts.push_back({mark_text(x), {foot[0], low_[1] - 14}});
  }
  for (const double y : y_.marks()) {
    const Flat::Place foot = place(x_.low, y);
    grid.paths.push_back({foot, {high_[0], foot[1]}});
    flat.texts.push_back({mark_text(y), {low_[0] - 8, foot[1]}, Flat::Text::Anchor::right});
  }
  flat.lines.push_back(grid);
  flat.lines.push_back({dark, 1.5, 1, {{low_, {high_[0], low_[1]}, high_, {low_[0], high_[1]}, low_}}});
  const double middle_x = (low_[0] + high_[0]) / 2, middle_y = (low_[1] + high_[1]) / 2;
  flat.texts.push_back({title, {middle_x, high_[1] + 18}, Flat::Text::Anchor::middle, 16});
  flat.texts.push_back({x_.title, {middle_x, low_[1] - 38}});
  flat.texts.push_back({y_.title, {low_[0] - 66, middle_y}, Flat::Text::Anchor::middle, 14, true});
}

}  // namespace gale::app
