#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/base/types.hpp>

// What is drawn: flat drawings and scenes, which know nothing of what draws them.

namespace gale::app {

/// Red, green and blue, 0 to 255.
using Color = std::array<std::uint8_t, 3>;

/// A flat drawing, such as a plot: in pixels, from its lower left corner; what comes later covers what came before.
struct Flat {
  using Place = std::array<double, 2>;

  struct Lines {
    Color color;
    double width, opacity;
    std::vector<std::vector<Place>> paths;
  };

  struct Dots {
    Color color;
    double size;
    std::vector<Place> places;
  };

  struct Text {
    enum class Anchor { left, middle, right };
    std::string text;
    Place place;  ///< where the anchor is, at half of the text's height
    Anchor anchor = Anchor::middle;
    double size = 14;
    bool upright = false;  ///< written from below to above
    Color color{40, 40, 40};
  };

  int width = 1200, height = 560;
  std::vector<Lines> lines;  ///< drawn before the dots
  std::vector<Dots> dots;
  std::vector<Text> texts;
};

using Point = std::array<double, 3>;

/// What a picture shows.
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
    bool has_steps = true;  ///< as voxels have: it is drawn smooth, and shining
  };

  std::vector<Balls> balls;
  double ball_radius = 1;
  std::vector<Tubes> tubes;
  Skin skin;
  Flat legend;              ///< drawn over it, as wide and high as the picture
  double part_of_mesh = 1;  ///< of the width, from the left; the rest is the legend's
  Point low{}, high{};      ///< corners of the whole mesh, whatever of it is drawn
};

}  // namespace gale::app
