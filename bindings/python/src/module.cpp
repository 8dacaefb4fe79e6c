#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <gale/base/configuration.hpp>
#include <gale/base/error.hpp>
#include <gale/io/formats.hpp>
#include <gale/mesh/segmentation.hpp>
#include <gale/version.hpp>

#include "mesh.hpp"
#include "process.hpp"
#include "ranks.hpp"
#include "tracker.hpp"

NB_MODULE(_gale, module) {
  namespace nb = nanobind;
  using namespace nb::literals;
  using gale::python::PyMesh;
  using gale::python::PyTracker;

  nb::set_leak_warnings(false);  // what users keep until the end is no fault of theirs
  static nb::exception<gale::Error> error(module, "Error", PyExc_ValueError);
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const gale::OutOfMemory& full) {
      PyErr_SetObject(PyExc_MemoryError, gale::python::text_of(full.what()).ptr());
    } catch (const gale::Error& refused) {
      PyErr_SetObject(error.ptr(), gale::python::text_of(refused.what()).ptr());
    }
  });
  module.attr("version") = gale::version;
  module.def("configuration", [] {
    const gale::Configuration is = gale::configuration();
    nb::dict named;
    named["version"] = is.version;
    named["commit"] = is.commit;
    named["kokkos"] = is.kokkos;
    named["backends"] = is.backends;
    named["options"] = is.options;
    named["compiler"] = is.compiler;
    return named;
  });
  module.attr("reads_files") = gale::io::detail::reads_files();
  module.attr("default_capacity") = gale::default_capacity;
  module.attr("has_cuda") = gale::device_is_cuda;
  module.def("finalize", &gale::python::finalize);
  module.def("after_fork", &gale::python::after_fork);
  module.def("device_array", &gale::python::device_array, "data"_a, "shape"_a, "type"_a, "bytes"_a, "owner"_a);
  module.def("from_cells", &gale::python::from_cells, "points"_a, "connectivity"_a, "offsets"_a, "types"_a,
             "capacity"_a);
  module.def("from_grid", &gale::python::from_grid, "points"_a, "nx"_a, "ny"_a, "nz"_a, "capacity"_a);
  module.def("read", &gale::python::read, "path"_a, "above"_a.none(), "array"_a, "tetrahedra_alone"_a,
             "outside_files"_a, "capacity"_a, "like"_a.none(), "time"_a.none());
  module.def("steps_of", &gale::python::steps_of, "inputs"_a, "outside_files"_a);

  gale::python::add_ranks(module);

  nb::class_<PyMesh>(module, "Mesh")
      .def(nb::init<gale::python::Array1, gale::python::Array1, int>(), "points"_a, "cells"_a, "capacity"_a)
      .def_prop_ro("vertices", &PyMesh::vertices)
      .def_prop_ro("dimension", &PyMesh::dimension)
      .def_prop_ro("cells", &PyMesh::cells)
      .def_prop_ro("segments", &PyMesh::segments)
      .def_prop_ro("capacity", &PyMesh::capacity)
      .def("points", &PyMesh::points)
      .def("cubes", &PyMesh::cubes)
      .def("relation", &PyMesh::relation, "name"_a, "threads"_a, "progress"_a.none())
      .def("analyse", &PyMesh::analyse, "analysis"_a, "field"_a, "name"_a, "given"_a, "threads"_a, "progress"_a.none(),
           "order"_a.none());

  nb::class_<PyTracker>(module, "Tracker")
      .def(nb::init<>())
      .def("add", &PyTracker::add, "time"_a, "mesh"_a, "field"_a, "name"_a, "threshold"_a, "threads"_a,
           "progress"_a.none())
      .def("found", &PyTracker::found);
}
