#include <algorithm>
#include <cmath>

#include <gale/app/drawing/arrays.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/app/drawing/skin.hpp>

namespace gale::app {

namespace {

/// Paths of each type that a picture shows, at most: with more of them nobody can follow one.
constexpr Id most_paths = 25;

class Painter {
 public:
  Painter(const io::Dataset& dataset, const MorseSmaleComplex& complex, const SimplexNumbers& numbers)
      : complex_(complex), skin_(dataset, complex.gradient.mesh(), numbers.on_surface) {}

  Scene paint(const io::PointArray& field, const io::PointSet& critical, const io::Surface& lines) {
    ShownPaths shown = shown_paths(lines, most_paths, [this](const Point& point) { return skin_.shows(point); });
    const std::size_t balls = paint_balls(critical, shown);
    std::vector<Color> samples;
    const auto color = [&](Id vertex, double brightness) {
      const Color sample = color_of(vertex, 0.95);
      if (samples.size() < 3 && std::find(samples.begin(), samples.end(), sample) == samples.end())
        samples.push_back(sample);
      return color_of(vertex, brightness);
    };
    skin_.paint(field, color, balls, scene_);
    scene_.legend = legend_of(complex_, shown, samples);
    scene_.part_of_mesh = part_left_of_legend;
    paint_tubes(std::move(shown));
    return std::move(scene_);
  }

 private:
  /// The ends of the paths that are shown; all critical simplices where no path is left out. Returns how many.
  std::size_t paint_balls(const io::PointSet& critical, const ShownPaths& shown) {
    const auto& dimensions = values_of<std::int8_t>(critical.arrays, "CellDimension");
    const auto& ids = values_of<Id>(critical.arrays, "CellId");
    const std::vector<Point> points = to_points(critical.points);
    std::size_t count = 0;
    for (int dimension = 0; dimension < 4; ++dimension)
      scene_.balls.push_back({color_of_simplices(complex_.gradient.mesh(), dimension), {}});
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!skin_.shows(points[i]) || (!shown.are_all() && shown.ends.count({dimensions[i], ids[i]}) == 0)) continue;
      scene_.balls[dimensions[i]].centres.push_back(points[i]);
      ++count;
    }
    return count;
  }

  /// Draws connectors first and thinner than the others; on triangles, where there are none, ascending paths.
  void paint_tubes(ShownPaths shown) {
    const bool has_connectors = complex_.gradient.mesh().dimension() == 3;
    for (const int type : {1, 0, 2}) {
      const int looks = type == 1 && !has_connectors ? 2 : type;
      const double radius = scene_.ball_radius * (looks == 1 ? 0.13 : 0.24);
      scene_.tubes.push_back({color_of_type[looks], radius, std::move(shown.kinds[type].stretches)});
    }
  }

  /// A hue for each pair of manifolds; paler where one is missing, grey where both are.
  Color color_of(Id vertex, double brightness) const {
    const auto label = [vertex](const Mirrored<Id>& manifold) {
      return manifold.size() != 0 ? manifold.in<HostMemory>()(vertex) : no_id;
    };
    const Id down = label(complex_.descending_manifold), up = label(complex_.ascending_manifold);
    const double turn = 0.6180339887498949 * (down + 1) + 0.7548776662466927 * (up + 1) +
                        0.33;  // irrational: labels nearby get hues far apart
    const int manifolds = (down != no_id) + (up != no_id);
    return to_color(turn - std::floor(turn), manifolds == 0 ? 0 : manifolds == 1 ? 0.15 : 0.3, brightness);
  }

  const MorseSmaleComplex& complex_;
  const Skin skin_;
  Scene scene_;
};

}  // namespace

Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1) {
  return Painter(dataset, complex, numbers).paint(field, critical, separatrices1);
}

}  // namespace gale::app
