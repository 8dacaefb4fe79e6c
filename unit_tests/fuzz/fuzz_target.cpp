// For libFuzzer and what speaks its language: the first byte says which format, the second with which options.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include <Kokkos_Core.hpp>

#include <gale/base/kokkos.hpp>
#include <gale/base/threads.hpp>

#include "fuzz/check_read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = [] {
    gale::set_host_threads(1);
    Kokkos::initialize(gale::initialization_arguments(1));
    const auto made = std::filesystem::temp_directory_path() / ("gale_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  static const char* const extensions[] = {".vtu",  ".vti", ".vtk", ".nii", ".nii.gz", ".mha", ".mhd",
                                           ".nrrd", ".e",   ".vtp", ".stl", ".ply",    ".obj", ".off"};
  if (size < 2) return 0;
  gale::fuzz::Case one;
  one.extension = extensions[data[0] % std::size(extensions)];
  one.options.simplices_alone = data[1] & 1;
  if (data[1] & 2) one.options.above = 2;
  one.content.assign(reinterpret_cast<const char*>(data) + 2, size - 2);
  const std::size_t split = one.content.find("\n\n");
  if ((data[1] & 4) && split != std::string::npos) {
    one.companion = one.content.substr(split + 2);
    one.content.resize(split + 2);
  }
  const std::string complaint = gale::fuzz::complaint_about(one, folder);
  if (!complaint.empty()) {
    std::fprintf(stderr, "%s\n", complaint.c_str());
    std::abort();
  }
  return 0;
}
