# Finds what GALE is built on. Read by our own build and, through the package config, by everyone who links GALE;
# GALE_ENABLE_* say which optional packages this GALE has.
#
# Each macro gale_find_* looks for some packages. Afterwards gale_missing holds a line for each that isn't there.

set(gale_missing "")

# gale_find(<package> <what to do about it> [find_package's arguments])
macro(gale_find package advice)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    list(APPEND gale_missing "GALE needs ${package}, which isn't found: ${advice}")
  endif()
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

# What the library's sources include. Gives gale::kokkoskernels.
macro(gale_find_kokkos_kernels)
  gale_find(KokkosKernels "install it, or set GALE_ENABLE_KOKKOS_KERNELS=OFF (no explicit structure then)" CONFIG)
  gale_adopt(kokkoskernels KokkosKernels Kokkos::kokkoskernels KokkosKernels::all_libs)
endmacro()

# What gale::io splits cells with, and the libraries for XML and compression that VTK has with it. Gives the targets of
# VTK_LIBRARIES.
macro(gale_find_vtk)
  gale_find(VTK "install it, or set GALE_ENABLE_VTK=OFF (grid:N inputs alone then)"
    COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersGeneral expat lz4 lzma zlib)
endmacro()

# What gale::distributed and those who include its headers need. Gives MPI::MPI_CXX, without MPI's old C++ interface.
macro(gale_find_mpi)
  set(MPI_CXX_SKIP_MPICXX ON)
  gale_find(MPI "install one, e.g. OpenMPI, or set GALE_ENABLE_MPI=OFF (one rank then)" COMPONENTS CXX)
endmacro()
