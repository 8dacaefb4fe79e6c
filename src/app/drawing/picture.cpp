#include <algorithm>
#include <cmath>

#include <gale/app/drawing/picture.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

using Triangle = std::array<Id, 3>;

/// Paths of each type that a picture shows, at most: with more of them nobody can follow one.
constexpr Id most_paths = 25;

/// A colour from its hue, saturation and value, each from 0 to 1.
Color to_color(double hue, double saturation, double value) {
  Color color;
  for (int i = 0; i < 3; ++i) {
    const double k = std::fmod(5 - 2 * i + 6 * hue, 6.0), strength = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    color[i] = static_cast<std::uint8_t>(std::lround(255 * value * (1 - saturation * strength)));
  }
  return color;
}

/// The part of the space that is cut out: all that is above a corner along every axis.
struct Octant {
  Point corner;

  bool has(const Point& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] < corner[axis]) return false;
    }
    return true;
  }
};

class Painter {
 public:
  Painter(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
          const SimplexNumbers& numbers)
      : points_(to_points(dataset.points)),
        complex_(complex),
        mesh_(complex.gradient.mesh()),
        is_surface_(mesh_.dimension() == 2),
        numbers_(numbers),
        field_(field) {
    measure();
  }

  Scene paint(const io::PointSet& critical, const io::Surface& lines) {
    ShownPaths shown = shown_paths(lines, most_paths, [this](const Point& point) { return octant_.has(point); });
    paint_skin();
    paint_balls(critical, shown);
    scene_.legend = legend_of(complex_, shown, skin_samples());
    paint_tubes(std::move(shown));
    return std::move(scene_);
  }

 private:
  /// Finds the mesh's extent and the octant. The octant's faces go through vertices, so that they are flat where the
  /// mesh is a grid.
  void measure() {
    scene_.low = scene_.high = points_[mesh_.vertex_input()(0)];
    for (const Point& point : points_) {
      for (int axis = 0; axis < 3; ++axis) {
        scene_.low[axis] = std::min(scene_.low[axis], point[axis]);
        scene_.high[axis] = std::max(scene_.high[axis], point[axis]);
      }
    }
    double size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = scene_.low[axis] + 0.48 * (scene_.high[axis] - scene_.low[axis]);
      const auto nearer = [&](const Point& a, const Point& b) {
        return std::abs(a[axis] - middle) < std::abs(b[axis] - middle);
      };
      octant_.corner[axis] = (*std::min_element(points_.begin(), points_.end(), nearer))[axis];
      size += (scene_.high[axis] - scene_.low[axis]) * (scene_.high[axis] - scene_.low[axis]);
    }
    size_ = std::sqrt(size);
    if (is_surface_) octant_.corner = scene_.low;  // nothing hides what lies on it
  }

  /// The ends of the paths that are shown; all critical simplices where no path is left out.
  void paint_balls(const io::PointSet& critical, const ShownPaths& shown) {
    const auto& dimensions = values_of<std::int8_t>(critical.arrays, "CellDimension");
    const auto& ids = values_of<Id>(critical.arrays, "CellId");
    const std::vector<Point> points = to_points(critical.points);
    std::size_t count = 0;
    for (const Color& color : color_of_dimension) scene_.balls.push_back({color, {}});
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!octant_.has(points[i]) || (!shown.are_all() && shown.ends.count({dimensions[i], ids[i]}) == 0)) continue;
      scene_.balls[is_surface_ && dimensions[i] == 2 ? 3 : dimensions[i]].centres.push_back(points[i]);
      ++count;
    }
    scene_.ball_radius = size_ * std::clamp(0.03 / std::cbrt(count + 1.0), 0.005, 0.008);
  }

  /// Draws connectors first and thinner than the others.
  void paint_tubes(ShownPaths shown) {
    for (const int type : {1, 0, 2}) {
      const int look = is_surface_ && type == 1 ? 2 : type;  // there those of type 1 ascend
      const double radius = scene_.ball_radius * (look == 1 ? 0.13 : 0.24);
      scene_.tubes.push_back({color_of_type[look], radius, std::move(shown.kinds[type].stretches)});
    }
  }

  /// Whether each tetrahedron is outside the octant; all of them where none is, because the mesh is too small to be
  /// cut.
  std::vector<char> left_tetrahedra() const {
    const auto& tetrahedra = mesh_.encoded().cells;
    std::vector<char> is_left(mesh_.cells());
    for (Id t = 0; t < mesh_.cells(); ++t) {
      Point middle{};
      for (int i = 0; i < 4; ++i) {
        for (int axis = 0; axis < 3; ++axis) middle[axis] += point(tetrahedra(t, i))[axis] / 4;
      }
      is_left[t] = !octant_.has(middle);
    }
    if (std::find(is_left.begin(), is_left.end(), 1) == is_left.end()) is_left.assign(is_left.size(), 1);
    return is_left;
  }

  /// The triangles of tetrahedra that are left whose three vertices are each on the mesh's surface or on the cut,
  /// between tetrahedra that are left and others. All triangles of the skin are among them.
  std::vector<Triangle> skin_candidates(const std::vector<char>& is_left) const {
    const auto& tetrahedra = mesh_.encoded().cells;
    std::vector<char> near_left(mesh_.vertices()), near_cut(mesh_.vertices());
    for (Id t = 0; t < mesh_.cells(); ++t) {
      for (int i = 0; i < 4; ++i) (is_left[t] ? near_left : near_cut)[tetrahedra(t, i)] = 1;
    }
    std::vector<Triangle> candidates;
    for (Id t = 0; t < mesh_.cells(); ++t) {
      if (!is_left[t]) continue;
      for (int corner = 0; corner < 4; ++corner) {
        Triangle triangle{};
        bool may_be = true;
        for (int i = 0, k = 0; i < 4; ++i) {
          if (i == corner) continue;
          const Id v = triangle[k++] = tetrahedra(t, i);
          may_be = may_be && (numbers_.on_surface(v) != 0 || (near_left[v] && near_cut[v]));
        }
        if (may_be) candidates.push_back(triangle);
      }
    }
    return candidates;
  }

  /// The skin: the triangles that exactly one of the tetrahedra that are left has; of a surface all.
  void paint_skin() {
    if (is_surface_) {
      std::vector<Triangle> all(mesh_.cells());
      for (Id t = 0; t < mesh_.cells(); ++t) {
        for (int i = 0; i < 3; ++i) all[t][i] = mesh_.encoded().cells(t, i);
      }
      return add_skin(all);
    }
    std::vector<Triangle> candidates = skin_candidates(left_tetrahedra());
    std::sort(candidates.begin(), candidates.end());
    std::vector<Triangle> skin;
    for (std::size_t i = 0, end = 0; i < candidates.size(); i = end) {
      while (end < candidates.size() && candidates[end] == candidates[i]) ++end;
      if (end == i + 1) skin.push_back(candidates[i]);
    }
    add_skin(skin);
  }

  void add_skin(const std::vector<Triangle>& triangles) {
    std::vector<Id> places(mesh_.vertices(), no_id);
    for (Triangle triangle : triangles) {
      for (Id& v : triangle) {
        if (places[v] == no_id) {
          places[v] = static_cast<Id>(skin_vertices_.size());
          skin_vertices_.push_back(v);
          scene_.skin.points.push_back(point(v));
        }
        v = places[v];
      }
      scene_.skin.triangles.push_back(triangle);
    }
    paint_manifolds();
  }

  void paint_manifolds() {
    std::vector<double> all(mesh_.vertices());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = outputs::value_at(field_, static_cast<Id>(v));
    std::sort(all.begin(), all.end());
    const double dark = all[all.size() / 20], bright = all[all.size() - 1 - all.size() / 100];
    for (const Id v : skin_vertices_) {
      const Id vertex = mesh_.vertex_input()(v);
      const double part = bright > dark && std::isfinite(bright - dark)
                              ? std::clamp((outputs::value_at(field_, vertex) - dark) / (bright - dark), 0.0, 1.0)
                              : 1;
      scene_.skin.colors.push_back(color_of(vertex, 0.75 + 0.25 * part));
    }
  }

  /// Three colours of the skin.
  std::vector<Color> skin_samples() const {
    std::vector<Color> samples;
    for (const Triangle& triangle : scene_.skin.triangles) {
      const Color color = color_of(mesh_.vertex_input()(skin_vertices_[triangle[0]]), 0.95);
      if (std::find(samples.begin(), samples.end(), color) == samples.end()) samples.push_back(color);
      if (samples.size() == 3) break;
    }
    return samples;
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

  const Point& point(Id v) const { return points_[mesh_.vertex_input()(v)]; }

  const std::vector<Point> points_;
  const MorseSmaleComplex& complex_;
  const Mesh mesh_;
  const bool is_surface_;
  const SimplexNumbers& numbers_;
  const io::PointArray& field_;
  Octant octant_{};
  std::vector<Id> skin_vertices_;  ///< GALE's ids, in the skin's order
  double size_ = 0;
  Scene scene_;
};

}  // namespace

Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1) {
  return Painter(dataset, field, complex, numbers).paint(critical, separatrices1);
}

}  // namespace gale::app
