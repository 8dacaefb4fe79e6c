#include <cerrno>
#include <cstring>
#include <fstream>

#include <gale/app/output_file.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

void require_writable(const std::string& path) {
  try {
    const io::AtomicFile file(path);
  } catch (const Error& error) {
    io::refuse_to_write(path, error.what());
  }
}

void write_text(const io::AtomicFile& file, const std::function<void(std::ostream&)>& write) {
  errno = 0;
  try {
    std::ofstream out;
    out.exceptions(std::ios::badbit | std::ios::failbit);  // which keeps errno as the failed write left it
    out.open(file.temporary());
    write(out);
    out.close();
  } catch (const std::ios::failure&) {
    io::refuse_to_write(file.path(), errno != 0 ? std::strerror(errno) : "not all of it could be written");
  }
}

}  // namespace gale::app
