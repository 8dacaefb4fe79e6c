#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include <gale/app/options.hpp>
#include <gale/app/output_file.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

namespace {

namespace fs = std::filesystem;

/// Where a path leads, as far as links can be followed.
fs::path real_path(const std::string& path) {
  std::error_code failure;
  const fs::path absolute = fs::absolute(path, failure), real = fs::weakly_canonical(absolute, failure);
  return failure ? absolute.lexically_normal() : real;
}

}  // namespace

void require_distinct(const std::vector<std::string>& files, const std::string& input) {
  std::set<fs::path> all{real_path(input)};
  std::error_code unknown;
  for (const std::string& file : files) {
    if (!all.insert(real_path(file)).second || fs::equivalent(file, input, unknown))
      throw UsageError("'" + file + "' is named for two files");
  }
}

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
