#include <dlfcn.h>
#include <unistd.h>

#include <exception>

#include <gale/app/drawing/drawer.hpp>
#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/installed.hpp>
#include <gale/version.hpp>

namespace gale::app {
namespace {

/// Loads the module, once.
const Drawer& loaded_drawer() {
  static const Drawer& drawer = []() -> const Drawer& {
    const std::string path = io::detail::find_installed(
        "gale-drawing.so", R_OK, "pictures (--render) are drawn",
        "where VTK has its rendering modules; in Python the results' plot() draws by matplotlib or PyVista");
    void* const module = dlopen(path.c_str(), RTLD_NOW);
    if (module == nullptr) io::detail::refuse("cannot draw (--render): ", dlerror());
    const auto get = reinterpret_cast<decltype(&gale_drawer)>(dlsym(module, "gale_drawer"));
    if (get == nullptr) io::detail::refuse("cannot draw (--render): ", dlerror());
    const Drawer* const found = get();
    const bool is_ours = found->version == std::string(version) && found->flat_bytes == sizeof(Flat) &&
                         found->scene_bytes == sizeof(Scene);
    if (!is_ours)
      io::detail::refuse("cannot draw (--render): ", path, " is of another build of GALE, version ", found->version);
    return *found;
  }();
  return drawer;
}

/// Throws what `draw` throws as gale::Error, a line that begins with `failure`.
template <class Draw>
void in_a_line(const std::string& failure, const Draw& draw) {
  try {
    draw();
  } catch (const std::exception& error) {
    throw Error(failure + io::detail::printable(error.what()));
  }
}

}  // namespace

void require_drawing() { in_a_line("", loaded_drawer().require_display); }

void draw(const io::AtomicFile& file, const Flat& flat) {
  in_a_line("cannot draw '" + file.path() + "': ", [&] { loaded_drawer().draw_flat(file.temporary(), flat); });
}

void draw(const io::AtomicFile& file, const Scene& scene) {
  in_a_line("cannot draw '" + file.path() + "': ", [&] { loaded_drawer().draw_scene(file.temporary(), scene); });
}

}  // namespace gale::app
