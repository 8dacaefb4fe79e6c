# A shared GALE isn't built on a static Kokkos: GALE and each program that links both would hold one. And none is built
# on a Kokkos-Kernels that brings another Kokkos' headers.
include(${CMAKE_ARGV3}/common.cmake)

list(REMOVE_ITEM configure_command ${kokkos})
set(archive ${here}/static_kokkos/lib/libkokkoscore.a)
file(WRITE ${archive} "")
file(WRITE ${here}/static_kokkos/KokkosConfig.cmake "
add_library(Kokkos::kokkoscore STATIC IMPORTED)
set_target_properties(Kokkos::kokkoscore PROPERTIES IMPORTED_LOCATION ${archive})
add_library(Kokkos::kokkos INTERFACE IMPORTED)
target_link_libraries(Kokkos::kokkos INTERFACE Kokkos::kokkoscore)
")
set(options -DKokkos_DIR=${here}/static_kokkos -DGALE_ENABLE_VTK=OFF -DGALE_ENABLE_APP=OFF
  -DGALE_ENABLE_TESTS=OFF -DGALE_ENABLE_EXAMPLES=OFF)
refused(${source} "a shared GALE needs a shared Kokkos, and ${archive} is static" -DBUILD_SHARED_LIBS=ON -DGALE_ENABLE_KOKKOS_KERNELS=OFF ${options})
configure(${source} ${here}/on_static_kokkos -DBUILD_SHARED_LIBS=OFF -DGALE_ENABLE_KOKKOS_KERNELS=OFF ${options})

set(kernels ${here}/other_kokkos)
file(WRITE ${kernels}/include/KokkosCore_config.h "")
file(WRITE ${kernels}/KokkosKernelsConfig.cmake "set(KokkosKernels_INCLUDE_DIRS ${kernels}/include)\n")
refused(${source} "brings a Kokkos of its own, in ${kernels}/include, and GALE takes the one in ${here}/static_kokkos" -DBUILD_SHARED_LIBS=OFF
  -DKokkosKernels_DIR=${kernels} ${options})
