# Builds the program against an installed GALE, and runs it:
#   cmake -DPREFIX=<GALE's> [-DBUILD=<folder>] [-DCMAKE_CXX_COMPILER=...] [-D<other cache entry>=...] -P run.cmake
cmake_minimum_required(VERSION 3.22)

if(NOT DEFINED BUILD)
  set(BUILD every_template)
endif()
set(options "")
get_cmake_property(names VARIABLES)
foreach(name IN LISTS names)
  if(name MATCHES "^(CMAKE_CXX_COMPILER|CMAKE_CXX_FLAGS|CMAKE_GENERATOR|[A-Za-z]+_DIR)$")
    list(APPEND options "-D${name}=${${name}}")
  endif()
endforeach()

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${BUILD} -DCMAKE_PREFIX_PATH=${PREFIX} ${options})
run(${CMAKE_COMMAND} --build ${BUILD} --parallel 2)
run(${CMAKE_CTEST_COMMAND} --test-dir ${BUILD} --output-on-failure --no-tests=error)
