#include <gale/app/drawing/scene.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

void require_drawing() {
  throw Error(
      "this gale was built without VTK's rendering modules, and cannot draw (--render): in Python the results' plot() "
      "draws by matplotlib or PyVista");
}

void draw(const io::AtomicFile&, const Scene&) { require_drawing(); }

void draw(const io::AtomicFile&, const Flat&) { require_drawing(); }

}  // namespace gale::app
