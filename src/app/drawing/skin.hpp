#pragma once

#include <functional>
#include <vector>

#include <gale/app/drawing/scene.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::app {

/// A colour from its hue, saturation and value, each from 0 to 1.
Color to_color(double hue, double saturation, double value);

/// What is seen of a mesh: of tetrahedra the skin of what is left when the octant of the mesh's high corner is cut
/// away; of triangles all.
class Skin {
 public:
  /// `on_surface` says of each vertex (GALE's id) whether it is there; of triangles it isn't read.
  Skin(const io::Dataset& dataset, const Mesh& mesh, const Array<const std::uint8_t, HostMemory>& on_surface);

  /// Whether a point is where one looks into the mesh: in the octant. On triangles, where one sees all, always.
  bool shows(const Point& point) const;

  /// Adds it to a scene, with corners and size of balls for so many of them: color_of(vertex, brightness) of each input
  /// vertex, brighter where the field is higher.
  using ColorOf = std::function<Color(Id vertex, double brightness)>;
  void paint(const io::PointArray& field, const ColorOf& color_of, std::size_t balls, Scene& scene) const;

 private:
  using Triangle = std::array<Id, 3>;

  void measure();
  void cut_tetrahedra();
  std::vector<char> left_tetrahedra();
  std::vector<Triangle> candidates(const std::vector<char>& is_left) const;
  const Point& point(Id v) const { return points_[mesh_.vertices_in_input()[v]]; }

  const Mesh mesh_;
  const Array<const std::uint8_t, HostMemory> on_surface_;
  const std::vector<Point> points_;
  Point low_{}, high_{};
  Point corner_{};  ///< of the octant
  bool is_cut_ = false;
  std::vector<Triangle> triangles_;  ///< of GALE's vertices
};

}  // namespace gale::app
