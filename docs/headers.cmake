# Says the paths of the public headers, for scripts/docs.sh: cmake -DPROJECT_SOURCE_DIR=... -P docs/headers.cmake
include(${PROJECT_SOURCE_DIR}/cmake/gale-headers.cmake)
list(TRANSFORM gale_public_headers PREPEND src/)
execute_process(COMMAND ${CMAKE_COMMAND} -E echo ${gale_public_headers})
