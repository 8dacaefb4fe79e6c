#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <gale/app/console.hpp>
#include <gale/app/drawing/picture.hpp>

namespace gale::app {

namespace {

/// A range of values along an axis of a plot.
struct Axis {
  double low, high;  ///< low < high, both finite; above 0 on a logarithmic axis
  bool is_logarithmic = false;
  std::string title;

  /// From 0 at `low` to 1 at `high`; what lies outside is brought to the nearer end.
  double along(double value) const {
    const auto scaled = [this](double at) { return is_logarithmic ? std::log10(at) : at; };
    const double inside = std::clamp(value, low, high);
    return (scaled(inside) - scaled(low)) / (scaled(high) - scaled(low));
  }

  /// Where it has marks: powers of ten, or some five round values.
  std::vector<double> marks() const {
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
    flat.texts.push_back({x_.title, {middle_x, low_[1] - 38}});
    flat.texts.push_back({y_.title, {low_[0] - 66, middle_y}, Flat::Text::Anchor::middle, 14, true});
  }

 private:
  Axis x_, y_;
  Flat::Place low_, high_;
};

using outputs::DiagramPoint;

constexpr Color type_colors[] = {{36, 95, 166}, {232, 150, 34}, {190, 50, 50}};
constexpr const char* type_names[] = {"minimum - 1-saddle", "1-saddle - 2-saddle", "2-saddle - maximum"};

std::vector<DiagramPoint> drawable(const std::vector<DiagramPoint>& diagram) {
  std::vector<DiagramPoint> some;
  std::copy_if(diagram.begin(), diagram.end(), std::back_inserter(some),
               [](const DiagramPoint& point) { return std::isfinite(point.birth) && std::isfinite(point.death); });
  return some;
}

void add_diagram(const std::vector<DiagramPoint>& diagram, const std::string& field, Flat& flat) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const DiagramPoint& point : diagram) {
    low = std::min(low, point.birth);
    high = std::max(high, point.death);
  }
  if (!(low < high)) {
    low = diagram.empty() ? 0 : low - 0.5;
    high = low + 1;
  }
  const Axes axes({low, high, false, "Birth (" + field + ")"}, {low, high, false, "Death"}, {90, 70}, {530, 510});
  axes.add_to("Persistence diagram", flat);
  flat.lines.push_back({{120, 120, 120}, 1, 1, {{axes.place(low, low), axes.place(high, high)}}});
  const auto add = [&](const Color& color, double opacity, double size, const auto& is_meant) {
    Flat::Lines bars{color, 1, opacity, {}};
    Flat::Dots dots{color, size, {}};
    for (const DiagramPoint& point : diagram) {
      if (!is_meant(point)) continue;
      bars.paths.push_back({axes.place(point.birth, point.birth), axes.place(point.birth, point.death)});
      dots.places.push_back(axes.place(point.birth, point.death));
    }
    flat.lines.push_back(bars);
    flat.dots.push_back(dots);
  };
  for (const int type : {1, 0, 2})
    add(type_colors[type], 0.25, 4, [&](const DiagramPoint& point) { return point.type == type && point.is_finite; });
  add({40, 40, 40}, 0.5, 7, [](const DiagramPoint& point) { return !point.is_finite; });
}

void add_curve(const std::vector<DiagramPoint>& diagram, Flat& flat) {
  const auto curve = outputs::persistence_curve(diagram);
  double least = HUGE_VAL, most = 0;
  for (const double persistence : curve.persistence) {
    if (persistence > 0) least = std::min(least, persistence);
    most = std::max(most, persistence);
  }
  if (!(least < most)) {
    least = most > 0 ? most / 10 : 0.1;
    most = most > 0 ? most * 10 : 1;
  }
  double pairs = 10;
  for (const auto& counts : curve.pairs) {
    for (const Id count : counts) pairs = std::max<double>(pairs, count);
  }
  const Axes axes({least, most, true, "Persistence"}, {1, pairs, true, "Pairs that persist"}, {690, 70}, {1130, 510});
  axes.add_to("Persistence curve", flat);
  for (int type = 0; type < 3; ++type) {
    // For all persistences down to the one before there are as many pairs as at one.
    std::vector<Flat::Place> steps;
    for (std::size_t i = 0; i < curve.persistence.size() && curve.pairs[type][i] > 0; ++i) {
      const double count = curve.pairs[type][i];
      steps.push_back(axes.place(i == 0 ? least : curve.persistence[i - 1], count));
      steps.push_back(axes.place(curve.persistence[i], count));
      if (i + 1 == curve.persistence.size() || curve.pairs[type][i + 1] == 0)
        steps.push_back(axes.place(curve.persistence[i], 1));
    }
    if (!steps.empty()) flat.lines.push_back({type_colors[type], 2, 1, {steps}});
  }
  double y = 135;
  for (int type = 0; type < 3; ++type, y -= 22) {
    flat.dots.push_back({type_colors[type], 8, {{706, y}}});
    flat.texts.push_back({type_names[type], {718, y}, Flat::Text::Anchor::left, 13});
  }
}

}  // namespace

Flat plot_of(const std::vector<DiagramPoint>& diagram, const std::string& field) {
  Flat flat;
  const auto some = drawable(diagram);
  add_diagram(some, field, flat);
  add_curve(some, flat);
  return flat;
}

}  // namespace gale::app
