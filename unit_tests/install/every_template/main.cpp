#include <cstdio>
#include <cstdlib>

#ifdef WITH_RANKS
#include <mpi.h>
#endif

#include "parts.hpp"

namespace every_template {

void expect(bool right, const char* what) {
  if (right) return;
  std::fprintf(stderr, "wrong: %s\n", what);
  std::exit(1);
}

}  // namespace every_template

int main(int argc, char** argv) {
#ifdef WITH_RANKS
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
#endif
  {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    every_template::use_meshes();
    every_template::use_fields();
    every_template::use_sweeps();
#ifdef WITH_RANKS
    every_template::use_ranks();
#endif
  }
#ifdef WITH_RANKS
  MPI_Finalize();
#endif
}
