#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <gale/app/drawing/axes.hpp>
#include <gale/app/drawing/picture.hpp>

namespace gale::app {

namespace {

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
