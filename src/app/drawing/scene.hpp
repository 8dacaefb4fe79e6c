#pragma once

#include <array>
#include <vector>

#include <gale/app/drawing/flat.hpp>
#include <gale/base/types.hpp>

namespace gale::app {

using Point = std::array<double, 3>;

/// What a picture shows; it knows nothing of what draws it.
struct Scene {
  /// Points of one kind, drawn as balls.
  struct Balls {
    Color color;
    std::vector<Point> centres;
  };

  /// Paths of one kind, drawn as tubes.
  struct Tubes {
    Color color;
    double radius;
    std::vector<std::vector<Point>> paths;
  };

  /// Triangles between coloured points.
  struct Skin {
    std::vector<Point> points;
    std::vector<Color> colors;
    std::vector<std::array<Id, 3>> triangles;
  };

  std::vector<Balls> balls;
  double ball_radius = 1;
  std::vector<Tubes> tubes;
  Skin skin;
  Flat legend;          ///< drawn over it, as wide and high as the picture
  Point low{}, high{};  ///< corners of the whole mesh, whatever of it is drawn
};

/// Throws gale::Error if this gale can't draw here: it was built without VTK's rendering, or there is no display where
/// VTK needs one.
void require_drawing();

/// Draws a scene, seen from its high corner, to the temporary of `file`, a PNG. Throws gale::Error, naming the file.
void draw(const io::AtomicFile& file, const Scene& scene);

}  // namespace gale::app
