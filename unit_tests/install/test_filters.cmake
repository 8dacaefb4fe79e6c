# The filters as other programs find them: by find_package(galevtk), and from Python.
include(${CMAKE_ARGV3}/common.cmake)

configure(${source}/unit_tests/install/filters ${here}/filters -DCMAKE_PREFIX_PATH=${prefix} ${vtk_dir}
  -DPYTHON=${vtk_python} -DPYTHON_PACKAGES=${vtk_python_packages})
build_and_test(${here}/filters)
