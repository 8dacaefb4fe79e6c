#include <algorithm>
#include <cmath>

#include <gale/app/drawing/arrays.hpp>
#include <gale/app/drawing/skin.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

Color to_color(double hue, double saturation, double value) {
  Color color;
  for (int i = 0; i < 3; ++i) {
    const double k = std::fmod(5 - 2 * i + 6 * hue, 6.0), strength = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    color[i] = static_cast<std::uint8_t>(std::lround(255 * value * (1 - saturation * strength)));
  }
  return color;
}

Skin::Skin(const io::Dataset& dataset, const Mesh& mesh, const Array<const std::uint8_t, HostMemory>& on_surface)
    : mesh_(mesh), on_surface_(on_surface), points_(to_points(dataset.points)) {
  measure();
  if (mesh.dimension() == 3) {
    cut_tetrahedra();
    return;
  }
  for (Id t = 0; t < mesh.cells(); ++t) {
    const Quad corners = mesh.cell_reader()(t);
    triangles_.push_back({corners[0], corners[1], corners[2]});
  }
}

/// Finds the mesh's extent and the octant. The octant's faces go through vertices, so that they are flat where the
/// mesh is a grid.
void Skin::measure() {
  low_ = high_ = points_.front();
  for (const Point& point : points_) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], point[axis]);
      high_[axis] = std::max(high_[axis], point[axis]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = low_[axis] + 0.48 * (high_[axis] - low_[axis]);
    const auto nearer = [&](const Point& a, const Point& b) {
      return std::abs(a[axis] - middle) < std::abs(b[axis] - middle);
    };
    corner_[axis] = (*std::min_element(points_.begin(), points_.end(), nearer))[axis];
  }
}

bool Skin::shows(const Point& point) const {
  if (mesh_.dimension() == 2) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] < corner_[axis]) return false;
  }
  return true;
}

/// Whether each tetrahedron is outside the octant; all of them where none is, because the mesh is too small to be cut.
std::vector<char> Skin::left_tetrahedra() {
  std::vector<char> is_left(mesh_.cells());
  for (Id t = 0; t < mesh_.cells(); ++t) {
    const Quad corners = mesh_.cell_reader()(t);
    Point middle{};
    for (int i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) middle[axis] += point(corners[i])[axis] / 4;
    }
    is_left[t] = !shows(middle);
  }
  is_cut_ = std::find(is_left.begin(), is_left.end(), 1) != is_left.end();
  if (!is_cut_) is_left.assign(is_left.size(), 1);
  return is_left;
}

/// The triangles of tetrahedra that are left whose three vertices are each on the mesh's surface or on the cut, between
/// tetrahedra that are left and others. All triangles of the skin are among them.
std::vector<Skin::Triangle> Skin::candidates(const std::vector<char>& is_left) const {
  std::vector<char> near_left(mesh_.vertices()), near_cut(mesh_.vertices());
  for (Id t = 0; t < mesh_.cells(); ++t) {
    const Quad corners = mesh_.cell_reader()(t);
    for (int i = 0; i < 4; ++i) (is_left[t] ? near_left : near_cut)[corners[i]] = 1;
  }
  std::vector<Triangle> candidates;
  for (Id t = 0; t < mesh_.cells(); ++t) {
    if (!is_left[t]) continue;
    const Quad corners = mesh_.cell_reader()(t);
    for (int corner = 0; corner < 4; ++corner) {
      Triangle triangle{};
      bool may_be = true;
      for (int i = 0, k = 0; i < 4; ++i) {
        if (i == corner) continue;
        const Id v = triangle[k++] = corners[i];
        may_be = may_be && (on_surface_(v) != 0 || (near_left[v] && near_cut[v]));
      }
      if (may_be) candidates.push_back(triangle);
    }
  }
  return candidates;
}

/// Finds the triangles that exactly one of the tetrahedra that are left has.
void Skin::cut_tetrahedra() {
  std::vector<Triangle> all = candidates(left_tetrahedra());
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end] == all[i]) ++end;
    if (end == i + 1) triangles_.push_back(all[i]);
  }
}

void Skin::paint(const io::PointArray& field, const ColorOf& color_of, std::size_t balls, Scene& scene) const {
  scene.low = low_;
  scene.high = high_;
  const double size = std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]);
  scene.ball_radius = size * std::clamp(0.03 / std::cbrt(balls + 1.0), 0.005, 0.008);
  scene.skin.has_steps = is_cut_;
  std::vector<double> all(mesh_.vertices());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = outputs::value_at(field, static_cast<Id>(v));
  std::sort(all.begin(), all.end());
  const double dark = all[all.size() / 20], bright = all[all.size() - 1 - all.size() / 100];
  std::vector<Id> places(mesh_.vertices(), no_id);
  for (Triangle triangle : triangles_) {
    for (Id& v : triangle) {
      if (places[v] == no_id) {
        places[v] = static_cast<Id>(scene.skin.points.size());
        scene.skin.points.push_back(point(v));
        const Id vertex = mesh_.vertices_in_input()[v];
        const double part = bright > dark && std::isfinite(bright - dark)
                                ? std::clamp((outputs::value_at(field, vertex) - dark) / (bright - dark), 0.0, 1.0)
                                : 1;
        scene.skin.colors.push_back(color_of(vertex, 0.75 + 0.25 * part));
      }
      v = places[v];
    }
    scene.skin.triangles.push_back(triangle);
  }
}

}  // namespace gale::app
