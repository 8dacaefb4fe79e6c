# COMPONENTS io and outputs give gale::io and gale::outputs. Static ones need VTK, and say so where it isn't; shared
# ones don't.
include(${CMAKE_ARGV3}/common.cmake)

set(consumer ${source}/unit_tests/install/consumer)
configure(${consumer} ${here}/components -DCMAKE_PREFIX_PATH=${prefix} ${vtk_dir} ${kokkos_kernels} "-DCOMPONENTS=io outputs")
build_and_test(${here}/components)

if(vtk)
  file(REMOVE_RECURSE ${here}/no_vtk)
  execute_process(COMMAND ${configure_command} -S ${consumer} -B ${here}/no_vtk -DCMAKE_PREFIX_PATH=${prefix}
    ${kokkos_kernels} -DCOMPONENTS=io -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON
    RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE message)
  if(shared)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "shared libraries ask for VTK: ${message}")
    endif()
  elseif(result EQUAL 0 OR NOT message MATCHES "GALE needs VTK")
    message(FATAL_ERROR "without VTK, COMPONENTS io says: ${message}")
  endif()
endif()

# COMPONENTS distributed gives gale::distributed, and MPI, where this GALE has it; else it isn't found.
if(mpi)
  configure(${consumer} ${here}/distributed -DCMAKE_PREFIX_PATH=${prefix} ${kokkos_kernels} -DCOMPONENTS=distributed)
  build_and_test(${here}/distributed)
else()
  file(REMOVE_RECURSE ${here}/distributed)
  execute_process(COMMAND ${configure_command} -S ${consumer} -B ${here}/distributed -DCMAKE_PREFIX_PATH=${prefix}
    ${kokkos_kernels} -DCOMPONENTS=distributed RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE message)
  if(result EQUAL 0 OR NOT message MATCHES "distributed")
    message(FATAL_ERROR "without MPI, COMPONENTS distributed says: ${message}")
  endif()
endif()
