# Programs and libraries load code from no folder that depends on where they are run; those that are installed, nor from
# where they were built.
include(${CMAKE_ARGV3}/common.cmake)

set(check ${python} -B ${source}/unit_tests/install/check_library_paths.py ${readelf})
run(${check} --in ${build})
run(${check} --in ${prefix} --never ${build} ${source})
