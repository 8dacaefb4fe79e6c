# COMPONENTS io and outputs give gale::io and gale::outputs, io alone the first. Static ones need VTK, and say so where it isn't; shared
# ones don't.
include(${CMAKE_ARGV3}/common.cmake)

set(consumer ${source}/unit_tests/install/consumer)
configure(${consumer} ${here}/components -DCMAKE_PREFIX_PATH=${prefix} ${vtk_dir} ${kokkos_kernels} "-DCOMPONENTS=io outputs")
build_and_test(${here}/components)
configure(${consumer} ${here}/files -DCMAKE_PREFIX_PATH=${prefix} ${vtk_dir} ${kokkos_kernels} -DCOMPONENTS=io)
build_and_test(${here}/files)

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

# COMPONENTS distributed and ttk give gale::distributed, and MPI, and gale::ttk, where this GALE has them; else they
# aren't found.
foreach(component has IN ZIP_LISTS optional_components has_optional_components)
  set(to ${here}/${component})
  if(has)
    configure(${consumer} ${to} -DCMAKE_PREFIX_PATH=${prefix} ${kokkos_kernels} -DCOMPONENTS=${component})
    build_and_test(${to})
  else()
    file(REMOVE_RECURSE ${to})
    execute_process(COMMAND ${configure_command} -S ${consumer} -B ${to} -DCMAKE_PREFIX_PATH=${prefix}
      ${kokkos_kernels} -DCOMPONENTS=${component} RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE message)
    if(result EQUAL 0 OR NOT message MATCHES "${component}")
      message(FATAL_ERROR "a GALE without ${component} says: ${message}")
    endif()
  endif()
endforeach()
