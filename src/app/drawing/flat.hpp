#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/io/atomic_file.hpp>

namespace gale::app {

/// Red, green and blue, 0 to 255.
using Color = std::array<std::uint8_t, 3>;

/// A flat drawing, such as a plot: in pixels, from its lower left corner; what comes later covers what came before. It
/// knows nothing of what draws it.
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
    Place place;  ///< of the anchor, at half of the text's height
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

/// Draws to a PNG file, the temporary of `file`. Throws gale::Error, naming the file.
void draw(const io::AtomicFile& file, const Flat& flat);

}  // namespace gale::app
