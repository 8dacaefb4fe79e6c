# Says which headers the reference of C++ describes, for scripts/docs.sh: the public ones, whatever a build has switched
# on, and those of the others whose classes public declarations hand out.
#   usage: cmake -DPROJECT_SOURCE_DIR=... -P docs/headers.cmake
set(GALE_ENABLE_MPI ON)
include(${PROJECT_SOURCE_DIR}/cmake/gale-headers.cmake)
set(handed_out base/mirrored.hpp runtime/batches/segment_batches.hpp)
foreach(header IN LISTS gale_public_headers handed_out)
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo gale/${header})
endforeach()
