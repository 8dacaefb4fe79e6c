#include <cerrno>
#include <cstring>
#include <fstream>

#include <gale/app/output_file.hpp>
#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>

namespace gale::app {

namespace {

/// Calls use(file) with a temporary file beside `path`. Throws gale::Error, naming the path, for whatever goes wrong.
template <class Use>
void with_file(const std::string& path, const Use& use) {
  try {
    io::AtomicFile file(path);
    use(file);
  } catch (const std::exception& error) {
    throw Error("cannot write '" + path + "': " + error.what());
  }
}

}  // namespace

void require_writable(const std::string& path) {
  with_file(path, [](const io::AtomicFile&) {});
}

void write_text(const std::string& path, const std::string& text) {
  with_file(path, [&](io::AtomicFile& file) {
    errno = 0;
    std::ofstream out(file.temporary());
    out << text;
    out.close();
    if (!out) throw Error(errno != 0 ? std::strerror(errno) : "the file cannot be written");
    file.commit();
  });
}

}  // namespace gale::app
