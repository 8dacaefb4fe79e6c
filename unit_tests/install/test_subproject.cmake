# As a subproject, GALE chooses no build type and installs nothing.
include(${CMAKE_ARGV3}/common.cmake)

set(parent_prefix ${here}/parent_prefix)
file(REMOVE_RECURSE ${parent_prefix})
configure(${source}/unit_tests/install/parent ${here}/parent -DGALE_SOURCE=${source} -DGALE_ENABLE_VTK=OFF
  -DGALE_ENABLE_KOKKOS_KERNELS=${has_kokkos_kernels} ${kokkos_kernels})
run(${CMAKE_COMMAND} --install ${here}/parent --prefix ${parent_prefix})
file(GLOB_RECURSE installed RELATIVE ${parent_prefix} ${parent_prefix}/*)
if(NOT installed STREQUAL "share/parent/CMakeLists.txt")
  message(FATAL_ERROR "the parent has installed: ${installed}")
endif()
