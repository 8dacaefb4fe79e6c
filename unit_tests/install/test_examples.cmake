# The examples build against the installed GALE, and run.
include(${CMAKE_ARGV3}/common.cmake)

configure(${source}/examples ${here}/examples -DCMAKE_PREFIX_PATH=${prefix} ${vtk_dir} ${kokkos_kernels})
build_and_test(${here}/examples)
