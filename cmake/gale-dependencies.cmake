# Finds what GALE is built on. Read by our own build and, through the package config, by everyone who links GALE;
# GALE_ENABLE_* say which optional packages this GALE has.
#
# Each macro gale_find_* looks for some packages. Afterwards gale_missing holds a line for each that isn't there.

set(gale_missing "")

# gale_find(<package> <what to do about it> [find_package's arguments]). Where gale_built_with_<package> says which
# version this GALE was built with, from <...>_dir, another one won't do: a program would load both.
macro(gale_find package advice)
  if(${package}_FOUND AND gale_built_with_${package} AND NOT "${${package}_VERSION}" STREQUAL gale_built_with_${package})
    gale_refuse(${package} "${${package}_VERSION}" "${${package}_DIR}")
  else()
    set(gale_package_arguments QUIET ${ARGN})
    if(gale_built_with_${package}_dir AND NOT ${package}_FOUND)
      list(APPEND gale_package_arguments HINTS ${gale_built_with_${package}_dir})
    endif()
    if(gale_built_with_${package} AND NOT ${package}_FOUND)
      list(PREPEND gale_package_arguments ${gale_built_with_${package}} EXACT)
    endif()
    find_package(${package} ${gale_package_arguments})
    if(${package}_FOUND)
    elseif(gale_built_with_${package} AND ${package}_CONSIDERED_VERSIONS AND NOT gale_built_with_${package} IN_LIST ${package}_CONSIDERED_VERSIONS)
      list(GET ${package}_CONSIDERED_VERSIONS 0 gale_other_version)
      list(GET ${package}_CONSIDERED_CONFIGS 0 gale_other_file)
      get_filename_component(gale_other_dir ${gale_other_file} DIRECTORY)
      gale_refuse(${package} "${gale_other_version}" "${gale_other_dir}")
    else()
      list(APPEND gale_missing "GALE needs ${package}, which isn't found: ${advice}")
    endif()
  endif()
endmacro()

macro(gale_refuse package version dir)
  string(CONCAT gale_refused "this GALE was built with ${package} ${gale_built_with_${package}}, and found is ${version} in ${dir}: "
    "set ${package}_DIR to where that version is now (it was in ${gale_built_with_${package}_dir})")
  list(APPEND gale_missing "${gale_refused}")
endmacro()

# gale_adopt(<name> <package> [<target>...]): gale::<name> is the first of the targets that exists. Trilinos up to 13 (Debian 12)
# sets variables alone, or names an include directory that isn't there; all others leave those variables empty.
function(gale_adopt name package)
  if(TARGET gale::${name} OR NOT ${package}_FOUND)
    return()
  endif()
  add_library(gale::${name} INTERFACE IMPORTED)
  if(${package}_INCLUDE_DIRS)
    target_include_directories(gale::${name} INTERFACE ${${package}_INCLUDE_DIRS})
    target_link_libraries(gale::${name} INTERFACE ${${package}_LIBRARIES})
    return()
  endif()
  foreach(target IN LISTS ARGN)
    if(TARGET ${target})
      target_link_libraries(gale::${name} INTERFACE ${target})
      return()
    endif()
  endforeach()
endfunction()

# What everyone who includes a header of GALE's needs. Gives gale::kokkos.
macro(gale_find_base)
  gale_find(Kokkos "install it, or name its prefix in CMAKE_PREFIX_PATH" CONFIG)
  gale_adopt(kokkos Kokkos Kokkos::kokkos)
  gale_find(Threads "install the compiler's thread library")
  if(NOT GALE_ENABLE_STD_THREADS)
    gale_find(OpenMP "take a compiler that has it, or set GALE_ENABLE_STD_THREADS=ON" COMPONENTS CXX)
  endif()
endmacro()

# Where a KokkosKernels has headers of another Kokkos than ours, as Trilinos' has; empty if it has none.
function(gale_own_kokkos result)
  foreach(dir IN LISTS Kokkos_INCLUDE_DIRS)
    file(REAL_PATH ${dir} dir)
    list(APPEND ours ${dir})
  endforeach()
  set(${result} "" PARENT_SCOPE)
  foreach(dir IN LISTS KokkosKernels_INCLUDE_DIRS)
    file(REAL_PATH ${dir} dir)
    if(EXISTS ${dir}/KokkosCore_config.h AND NOT dir IN_LIST ours)
      set(${result} ${dir} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# What the library's sources include. Gives gale::kokkoskernels.
macro(gale_find_kokkos_kernels)
  gale_find(KokkosKernels "install it, or set GALE_ENABLE_KOKKOS_KERNELS=OFF (no explicit structure then)" CONFIG)
  gale_own_kokkos(gale_other_kokkos)
  if(gale_other_kokkos)
    list(APPEND gale_missing "the KokkosKernels in ${KokkosKernels_DIR} brings a Kokkos of its own, in ${gale_other_kokkos}, and GALE takes the one in ${Kokkos_DIR}: set KokkosKernels_DIR to one that was built with that, or GALE_ENABLE_KOKKOS_KERNELS=OFF (no explicit structure then)")
  endif()
  gale_adopt(kokkoskernels KokkosKernels Kokkos::kokkoskernels KokkosKernels::all_libs)
endmacro()

# What brings gale::io the libraries for XML and compression. Gives the targets of VTK_LIBRARIES.
macro(gale_find_vtk)
  gale_find(VTK "install it, or set GALE_ENABLE_VTK=OFF (grid:N inputs alone then)"
    COMPONENTS CommonCore CommonMisc expat lz4 lzma zlib)
endmacro()

# What stands for VTK there (GALE_ENABLE_SYSTEM_LIBRARIES): gale_file_libraries, by their files, and gale_file_include_dirs.
# Asked for by our own build alone.
macro(gale_find_file_libraries)
  set(gale_file_libraries "")
  set(gale_file_include_dirs "")
  if(GALE_ENABLE_VTK)
    list(APPEND gale_missing "GALE_ENABLE_SYSTEM_LIBRARIES stands for VTK: set GALE_ENABLE_VTK=OFF, or do without it")
  endif()
  foreach(library expat lz4 lzma z)
    string(REGEX REPLACE "^z$" "zlib" gale_header ${library})
    string(TOUPPER ${library} gale_name)
    find_path(GALE_${gale_name}_INCLUDE_DIR ${gale_header}.h DOC "Where the header of ${library} is")
    find_library(GALE_${gale_name}_LIBRARY ${library} DOC "The library ${library}, which files are read with")
    mark_as_advanced(GALE_${gale_name}_INCLUDE_DIR GALE_${gale_name}_LIBRARY)
    if(GALE_${gale_name}_INCLUDE_DIR AND GALE_${gale_name}_LIBRARY)
      list(APPEND gale_file_libraries ${GALE_${gale_name}_LIBRARY})
      list(APPEND gale_file_include_dirs ${GALE_${gale_name}_INCLUDE_DIR})
    else()
      list(APPEND gale_missing "GALE needs the library ${library} and its header ${gale_header}.h: install them, or set GALE_ENABLE_SYSTEM_LIBRARIES=OFF (grid:N inputs alone then)")
    endif()
  endforeach()
endmacro()

# What gale::distributed and those who include its headers need. Gives MPI::MPI_CXX, without MPI's old C++ interface, and
# gale_mpi, whose it is: others have types of other sizes.
macro(gale_find_mpi)
  set(MPI_CXX_SKIP_MPICXX ON)
  gale_find(MPI "install one, e.g. OpenMPI, or set GALE_ENABLE_MPI=OFF (one rank then)" COMPONENTS CXX)
  set(gale_mpi "")
  if(EXISTS "${MPI_CXX_HEADER_DIR}/mpi.h")
    file(STRINGS ${MPI_CXX_HEADER_DIR}/mpi.h gale_mpi REGEX "define +(OPEN_MPI|MPICH_VERSION|I_MPI_VERSION) ")
  endif()
  if(gale_mpi MATCHES "OPEN_MPI")
    set(gale_mpi "Open MPI")
  elseif(gale_mpi)
    set(gale_mpi "MPICH, or one of its interface,")
  endif()
  if(gale_mpi AND gale_built_with_mpi AND NOT gale_mpi STREQUAL gale_built_with_mpi)
    string(CONCAT gale_refused "this GALE was built with ${gale_built_with_mpi}, and found is ${gale_mpi} in ${MPI_CXX_HEADER_DIR}: "
      "set MPI_CXX_COMPILER to the former's")
    list(APPEND gale_missing "${gale_refused}")
  endif()
endmacro()
