#include <algorithm>
#include <cctype>
#include <cmath>

#include <gale/app/drawing/arrays.hpp>
#include <gale/app/drawing/axes.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/drawing/planar_tree.hpp>
#include <gale/app/drawing/skin.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

/// Branches that a picture shows, at most: with more of them nobody can tell their colours.
constexpr Id most_branches = 24;

constexpr Flat::Place plot_low = {880, 150}, plot_high = {1370, 750};

/// The colour of an arc that is drawn; grey for none.
Color color_of(Id arc, double saturation, double brightness) {
  const double turn = 0.6180339887498949 * (arc + 1);  // irrational: arcs nearby get hues far apart
  return to_color(turn - std::floor(turn), arc == no_id ? 0 : saturation, brightness);
}

/// The heights of nodes, and their axis: the field; their order where the field is the same everywhere or isn't finite.
Axis measure(const io::PointArray& field, const MergeTree& tree, std::vector<double>& heights) {
  for (const Id vertex : tree.vertices) heights.push_back(outputs::value_at(field, vertex));
  std::string title = field.name;
  if (!(heights.front() < heights.back()) || !std::isfinite(heights.back() - heights.front())) {
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<double>(i);
    title = "Order of " + title;
  }
  const double margin = std::max(0.03 * (heights.back() - heights.front()), 1e-9 * std::abs(heights.back()) + 1e-300);
  return {heights.front() - margin, heights.back() + margin, false, title};
}

/// Says what nodes are, in a row, and below it what is shown.
void add_legend(const PlanarTree& planar, const std::vector<Flat::Dots>& nodes, Flat& flat) {
  static constexpr const char* names[] = {"minimum", "joins", "splits", "maximum", "other"};
  double x = plot_low[0];
  for (std::size_t type = 0; type < nodes.size(); ++type) {
    if (nodes[type].places.empty()) continue;
    flat.dots.push_back({nodes[type].color, 13, {{x + 6, 100}}});
    flat.texts.push_back({names[type], {x + 20, 100}, Flat::Text::Anchor::left, 16});
    x += 48 + 9 * std::string(names[type]).size();
  }
  double y = 66;
  const auto add = [&](const std::string& line) {
    flat.texts.push_back({line, {plot_low[0], y}, Flat::Text::Anchor::left, 14});
    y -= 21;
  };
  add("A colour for each arc and its part of the mesh.");
  if (planar.shown < planar.branches) {
    add("Of " + grouped(planar.branches) + " branches the " + grouped(planar.shown) + " most persistent;");
    add("others have the colours of what they hang on.");
  }
}

Flat plot_of(const PlanarTree& planar, const MergeTree& tree, const Axis& heights, const std::string& name) {
  Flat flat;
  flat.width = 1400;
  flat.height = 800;
  const Axes axes({0, 1}, heights, plot_low, plot_high);
  axes.add_to(static_cast<char>(std::toupper(static_cast<unsigned char>(name[0]))) + name.substr(1) + " tree", flat);
  for (std::size_t i = 0; i < planar.arcs.size(); ++i) {
    Flat::Lines line{color_of(static_cast<Id>(i), 0.62, 0.9), 5, 1, {{}}};
    for (const auto& place : planar.arcs[i]) line.paths[0].push_back(axes.place(place[0], place[1]));
    flat.lines.push_back(line);
  }
  std::vector<Flat::Dots> nodes;
  for (const Color& color : color_of_critical) nodes.push_back({color, 11, {}});
  for (const auto& node : planar.nodes)
    nodes[static_cast<int>(tree.types[node.node])].places.push_back(axes.place(node.place[0], node.place[1]));
  flat.dots = nodes;
  add_legend(planar, nodes, flat);
  return flat;
}

}  // namespace

Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const Mesh& mesh, const MergeTree& tree,
                 const std::string& name, const Array<const std::uint8_t, HostMemory>& on_surface) {
  std::vector<double> heights;
  const Axis axis = measure(field, tree, heights);
  const PlanarTree planar = planar_tree(tree, heights, most_branches);
  const Skin skin(dataset, mesh, on_surface);
  Scene scene;
  scene.part_of_mesh = 0.57;
  for (const Color& color : color_of_critical) scene.balls.push_back({color, {}});
  std::size_t count = 0;
  const std::vector<Point> points = to_points(dataset.points);
  for (const auto& node : planar.nodes) {
    const Point& point = points[tree.vertices[node.node]];
    if (!skin.shows(point)) continue;
    scene.balls[static_cast<int>(tree.types[node.node])].centres.push_back(point);
    ++count;
  }
  const auto color = [&](Id vertex, double brightness) {
    const Id arc = tree.arc_of[vertex];
    return color_of(arc == no_id ? no_id : planar.arc_of[arc], 0.45, brightness);
  };
  skin.paint(field, color, count, scene);
  scene.legend = plot_of(planar, tree, axis, name);
  return scene;
}

}  // namespace gale::app
