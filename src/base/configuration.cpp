#include <gale/base/configuration.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/built_with.hpp>
#include <gale/version.hpp>

namespace gale {

namespace {

std::vector<std::string> backends() {
  std::vector<std::string> names;
#if defined(KOKKOS_ENABLE_CUDA)
  names.push_back("Cuda");
#endif
#if defined(KOKKOS_ENABLE_HIP)
  names.push_back("HIP");
#endif
#if defined(KOKKOS_ENABLE_OPENMP)
  names.push_back("OpenMP");
#endif
#if defined(KOKKOS_ENABLE_THREADS)
  names.push_back("Threads");
#endif
#if defined(KOKKOS_ENABLE_SERIAL)
  names.push_back("Serial");
#endif
  return names;
}

}  // namespace

Configuration configuration() {
  return {version, GALE_COMMIT, kokkos_version(), backends(), {GALE_OPTIONS}, GALE_COMPILER};
}

}  // namespace gale
