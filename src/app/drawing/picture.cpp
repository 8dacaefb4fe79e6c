#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <gale/app/console.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

using Triangle = std::array<Id, 3>;

/// Of critical simplices, by dimension.
const Color color_of_dimension[] = {{26, 89, 217}, {26, 168, 150}, {245, 166, 26}, {214, 31, 36}};
/// Of 1-separatrices, by type: descending, connectors, ascending.
const Color color_of_type[] = {{92, 142, 232}, {150, 150, 158}, {236, 112, 86}};

/// Points of either type, as doubles.
std::vector<Point> to_points(const std::variant<io::Dataset::Points<float>, io::Dataset::Points<double>>& points) {
  std::vector<Point> all;
  std::visit(
      [&](const auto& rows) {
        all.resize(rows.extent(0));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = {rows(i, 0), rows(i, 1), rows(i, 2)};
      },
      points);
  return all;
}

/// The values of the array of that name and type, which must be there.
template <class T>
const std::vector<T>& values_of(const std::vector<io::PointArray>& arrays, const std::string& name) {
  const auto at =
      std::find_if(arrays.begin(), arrays.end(), [&](const io::PointArray& array) { return array.name == name; });
  return std::get<std::vector<T>>(at->values);
}

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
        numbers_(numbers),
        field_(field) {
    measure();
  }

  Scene paint(const io::PointSet& critical, const io::Surface& lines) {
    paint_balls(critical);
    paint_tubes(lines);
    paint_skin();
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
  }

  void paint_balls(const io::PointSet& critical) {
    static const char* const names[] = {"minima", "1-saddles", "2-saddles", "maxima"};
    const auto counts = complex_.critical.counts();
    const auto& dimensions = values_of<std::int8_t>(critical.arrays, "CellDimension");
    const std::vector<Point> points = to_points(critical.points);
    std::size_t shown = 0;
    for (int dimension = 0; dimension < 4; ++dimension) {
      Scene::Balls balls{grouped(counts[dimension]) + ' ' + names[dimension], color_of_dimension[dimension], {}};
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (dimensions[i] == dimension && octant_.has(points[i])) balls.centres.push_back(points[i]);
      }
      shown += balls.centres.size();
      scene_.balls.push_back(std::move(balls));
    }
    scene_.ball_radius = size_ * std::clamp(0.045 / std::cbrt(shown + 1.0), 0.0025, 0.008);
  }

  /// Draws connectors first and thinner than the others.
  void paint_tubes(const io::Surface& lines) {
    static constexpr int tubes_of_type[] = {1, 0, 2};
    for (const int type : {1, 0, 2})
      scene_.tubes.push_back({color_of_type[type], scene_.ball_radius * (type == 1 ? 0.14 : 0.27), {}});
    const std::vector<Point> points = to_points(lines.points);
    const auto& types = values_of<std::int8_t>(lines.cell_arrays, "SeparatrixType");
    const auto& mask = values_of<std::int8_t>(lines.point_arrays, "ttkMaskScalarField");
    const auto& ids = values_of<Id>(lines.point_arrays, "CellId");
    std::unordered_set<std::uint64_t> seen[3];
    for (std::size_t first = 0, line = 0; first < points.size();) {
      std::size_t last = first + 1;  // of the path that begins at `first`
      while (mask[last] != 0) ++last;
      const int type = types[line];
      std::vector<bool> is_new(last - first);
      for (std::size_t k = first; k < last; ++k) {
        if (!octant_.has(points[k]) || !octant_.has(points[k + 1])) continue;
        // The ids of a line's ends, that of the path's first dimension first: the two dimensions take turns.
        const std::size_t even = k + (k - first) % 2, odd = even == k ? k + 1 : k;
        const auto key = std::uint64_t(ids[even]) << 32 | static_cast<std::uint32_t>(ids[odd]);
        is_new[k - first] = seen[type].insert(key).second;
      }
      if (std::find(is_new.begin(), is_new.end(), true) != is_new.end()) {
        add_path(smoothed({points.begin() + first, points.begin() + last + 1}), is_new,
                 scene_.tubes[tubes_of_type[type]].paths);
      }
      line += last - first;
      first = last + 1;
    }
  }

  /// The path with each point but the ends moved towards the middle of its neighbours, twenty times.
  static std::vector<Point> smoothed(std::vector<Point> path) {
    std::vector<Point> next = path;
    for (int i = 0; i < 20; ++i, path.swap(next)) {
      for (std::size_t k = 1; k + 1 < path.size(); ++k) {
        for (int axis = 0; axis < 3; ++axis)
          next[k][axis] = path[k][axis] / 2 + (path[k - 1][axis] + path[k + 1][axis]) / 4;
      }
    }
    return path;
  }

  /// Adds the stretches of a path that are new: in the octant, and drawn for no other path before. Many paths share
  /// most of their way.
  static void add_path(const std::vector<Point>& path, const std::vector<bool>& is_new,
                       std::vector<std::vector<Point>>& paths) {
    for (std::size_t k = 0; k < is_new.size(); ++k) {
      if (!is_new[k]) continue;
      if (k == 0 || !is_new[k - 1]) paths.push_back({path[k]});
      paths.back().push_back(path[k + 1]);
    }
  }

  /// Whether each tetrahedron is outside the octant; all of them where none is, because the mesh is too small to be
  /// cut.
  std::vector<char> left_tetrahedra() const {
    const auto& tetrahedra = mesh_.encoded().tetrahedra;
    std::vector<char> is_left(mesh_.tetrahedra());
    for (Id t = 0; t < mesh_.tetrahedra(); ++t) {
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
    const auto& tetrahedra = mesh_.encoded().tetrahedra;
    std::vector<char> near_left(mesh_.vertices()), near_cut(mesh_.vertices());
    for (Id t = 0; t < mesh_.tetrahedra(); ++t) {
      for (int i = 0; i < 4; ++i) (is_left[t] ? near_left : near_cut)[tetrahedra(t, i)] = 1;
    }
    std::vector<Triangle> candidates;
    for (Id t = 0; t < mesh_.tetrahedra(); ++t) {
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

  /// The skin: the triangles that exactly one of the tetrahedra that are left has.
  void paint_skin() {
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
    std::vector<Id> places(mesh_.vertices(), no_id), vertices;
    for (Triangle triangle : triangles) {
      for (Id& v : triangle) {
        if (places[v] == no_id) {
          places[v] = static_cast<Id>(vertices.size());
          vertices.push_back(v);
          scene_.skin.points.push_back(point(v));
        }
        v = places[v];
      }
      scene_.skin.triangles.push_back(triangle);
    }
    paint(vertices);
  }

  void paint(const std::vector<Id>& vertices) {
    std::vector<double> all(mesh_.vertices());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = outputs::value_at(field_, static_cast<Id>(v));
    std::sort(all.begin(), all.end());
    const double dark = all[all.size() / 20], bright = all[all.size() - 1 - all.size() / 100];
    for (const Id v : vertices) {
      const Id vertex = mesh_.vertex_input()(v);
      const double part = bright > dark && std::isfinite(bright - dark)
                              ? std::clamp((outputs::value_at(field_, vertex) - dark) / (bright - dark), 0.0, 1.0)
                              : 1;
      scene_.skin.colors.push_back(color_of(vertex, 0.62 + 0.38 * part));
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
    return to_color(turn - std::floor(turn), manifolds == 0 ? 0 : manifolds == 1 ? 0.3 : 0.5, brightness);
  }

  const Point& point(Id v) const { return points_[mesh_.vertex_input()(v)]; }

  const std::vector<Point> points_;
  const MorseSmaleComplex& complex_;
  const Mesh mesh_;
  const SimplexNumbers& numbers_;
  const io::PointArray& field_;
  Octant octant_{};
  double size_ = 0;
  Scene scene_;
};

}  // namespace

Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1) {
  return Painter(dataset, field, complex, numbers).paint(critical, separatrices1);
}

}  // namespace gale::app
