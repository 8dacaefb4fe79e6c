#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <gale/io/bytes/text.hpp>
#include <gale/io/installed.hpp>

namespace gale::io::detail {
namespace {

namespace fs = std::filesystem;

/// The folder of the program, or of the library or module, that holds this code.
fs::path own_folder() {
  static const int here = 0;
  std::error_code unknown;
  Dl_info info;
  const bool is_known = dladdr(&here, &info) != 0 && std::strchr(info.dli_fname, '/') != nullptr;
  const fs::path own = is_known ? fs::canonical(info.dli_fname, unknown) : fs::path();
  return (own.empty() ? fs::read_symlink("/proc/self/exe", unknown) : own).parent_path();
}

}  // namespace

std::string find_installed(const std::string& name, int access, const char* use, const char* origin) {
  const fs::path own = own_folder();
  const char* const said = std::getenv("GALE_LIBEXEC");
  // Looks where the user says, beside it, where the Python module has it, and where GALE was to be installed.
  for (const fs::path& folder :
       {fs::path(said == nullptr ? "" : said), own, own / "bin", own / GALE_LIBEXEC_FROM_BIN, fs::path(GALE_LIBEXEC)}) {
    if (folder.empty()) continue;
    const fs::path file = folder / name;
    if (::access(file.c_str(), access) == 0) return file.string();
  }
  std::error_code none;  // a wheel's users don't have the folder that it was to be installed to
  const std::string elsewhere = fs::exists(GALE_LIBEXEC, none) ? " nor in " GALE_LIBEXEC : "";
  refuse(use, " by ", name, ", which isn't beside ", own.string(), elsewhere,
         " nor in the folder that the variable GALE_LIBEXEC names: it is built ", origin);
}

}  // namespace gale::io::detail
