# A program gets the versions of packages that GALE was built with, and is told in one line where it has another: it would
# load both.
include(${CMAKE_ARGV3}/common.cmake)

set(consumer ${source}/unit_tests/install/versions)
set(other ${here}/other_versions)
list(REMOVE_ITEM configure_command ${kokkos}) # left to the package to find
file(REMOVE_RECURSE ${other})

foreach(package version IN ZIP_LISTS built_with built_with_versions)
  file(WRITE ${other}/lib/cmake/${package}/${package}Config.cmake "")
  file(WRITE ${other}/lib/cmake/${package}/${package}ConfigVersion.cmake
    "set(PACKAGE_VERSION 0.9.8)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endforeach()

# The other version's prefix is searched before all others.
configure(${consumer} ${here}/versions -DCMAKE_PREFIX_PATH=${other} -Dgale_DIR=${package_dir})
foreach(package version dir IN ZIP_LISTS built_with built_with_versions built_with_dirs)
  file(STRINGS ${here}/versions/CMakeCache.txt found REGEX "^${package}_DIR:")
  if(NOT found STREQUAL "${package}_DIR:PATH=${dir}")
    message(FATAL_ERROR "built with the ${package} in ${dir}, but the program gets ${found}")
  endif()

  # The program has found the other version before GALE; and there is no other, since GALE's own has gone.
  set(message "this GALE was built with ${package} ${version}, and found is 0.9.8 in ${other}/lib/cmake/${package}: set ${package}_DIR ")
  refused(${consumer} "${message}" -DCMAKE_PREFIX_PATH=${prefix} -DFIRST=${package} -DOTHER=${other})
  set(moved ${here}/moved/lib/cmake/gale)
  file(REMOVE_RECURSE ${moved})
  file(COPY ${package_dir}/ DESTINATION ${moved})
  file(READ ${moved}/gale-config.cmake config)
  string(REPLACE "_dir \"${dir}\"" "_dir \"/nowhere\"" config "${config}")
  file(WRITE ${moved}/gale-config.cmake "${config}")
  refused(${consumer} "${message}" -Dgale_DIR=${moved} -DCMAKE_PREFIX_PATH=${other} -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF
    -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
endforeach()

# MPI's headers say whose they are.
if(mpi)
  file(WRITE ${other}/include/mpi.h "#define MPICH_VERSION \"4.0\"\n")
  set(kind "MPICH, or one of its interface,")
  if(NOT mpi STREQUAL "Open MPI")
    set(kind "Open MPI")
    file(WRITE ${other}/include/mpi.h "#define OPEN_MPI 1\n")
  endif()
  refused(${consumer} "this GALE was built with ${mpi}, and found is ${kind} in ${other}/include: set MPI_CXX_COMPILER"
    -DCMAKE_PREFIX_PATH=${prefix} -DCOMPONENTS=distributed -DMPI_CXX_HEADER_DIR=${other}/include)
endif()
