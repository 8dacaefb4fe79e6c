#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/base/types.hpp>
#include <gale/io/atomic_file.hpp>

namespace gale::app {

using Point = std::array<double, 3>;

/// Red, green and blue, 0 to 255.
using Color = std::array<std::uint8_t, 3>;

/// What a picture shows; it knows nothing of what draws it.
struct Scene {
  /// Points of one kind, drawn as balls. The caption is for the legend.
  struct Balls {
    std::string caption;
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
  Point low{}, high{};  ///< corners of the whole mesh, whatever of it is drawn
};

/// Throws gale::Error if this gale can't draw here: it was built without VTK's rendering, or there is no display where
/// VTK needs one.
void require_drawing();

/// Draws a scene, seen from its high corner, to the temporary of `file`, a PNG. Throws gale::Error, naming the file.
void draw(const io::AtomicFile& file, const Scene& scene);

}  // namespace gale::app
