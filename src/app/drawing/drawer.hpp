#pragma once

#include <cstddef>
#include <string>

#include <gale/app/drawing/scene.hpp>

// Pictures are drawn by a module, gale-drawing.so, that is loaded for them: VTK's rendering libraries take longer to
// load than all that most commands do.

namespace gale::io {
class AtomicFile;
}

namespace gale::app {

/// What that module has. Each function throws std::exception; files are named by their paths.
struct Drawer {
  const char* version;                  ///< of GALE
  std::size_t flat_bytes, scene_bytes;  ///< of a Flat and a Scene: who has others was compiled from other sources
  void (*require_display)();            ///< throws where VTK needs a display and there is none
  void (*draw_flat)(const std::string& file, const Flat& flat);
  void (*draw_scene)(const std::string& file, const Scene& scene);
};

/// Throws gale::Error if this gale can't draw here: the module isn't there, or there is no display where VTK needs one.
void require_drawing();

/// Draws to a PNG file, the temporary of `file`. Throws gale::Error, naming the file.
void draw(const io::AtomicFile& file, const Flat& flat);

/// Draws a scene, seen from its high corner, or from above if it is flat, to the temporary of `file`, a PNG. Throws
/// gale::Error, naming the file.
void draw(const io::AtomicFile& file, const Scene& scene);

}  // namespace gale::app

/// What the module exports.
extern "C" __attribute__((visibility("default"))) const gale::app::Drawer* gale_drawer();
