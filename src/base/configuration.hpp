#pragma once

#include <string>
#include <vector>

#include <gale/export.hpp>

namespace gale {

/// What this GALE is and was built with: for reports of defects, and for programs that meet a library other than the
/// headers that they were compiled with.
struct Configuration {
  std::string version;                ///< the library's, "0.1.0"; that of the headers is gale::version
  std::string commit;                 ///< names the sources, in hexadecimal; empty where they have no history
  std::string kokkos;                 ///< the version of Kokkos, "4.6.1"
  std::vector<std::string> backends;  ///< Kokkos' execution spaces, such as "Serial", "OpenMP", "Cuda"
  std::vector<std::string> options;   ///< libraries that it has, with their versions, and how it was built
  std::string compiler;               ///< its name and version; with a device's compiler that one's, too
};

/// Tells what the library is that the program runs with. Any thread may call it, and Kokkos needn't be initialized.
GALE_EXPORT Configuration configuration();

}  // namespace gale
