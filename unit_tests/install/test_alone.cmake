# Who links gale::gale alone is asked for neither VTK nor Kokkos-Kernels.
include(${CMAKE_ARGV3}/common.cmake)

configure(${source}/unit_tests/install/consumer ${here}/alone -DCMAKE_PREFIX_PATH=${prefix}
  -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_DISABLE_FIND_PACKAGE_KokkosKernels=${no_kokkos_kernels})
build_and_test(${here}/alone)
