#pragma once

#include <nanobind/nanobind.h>

namespace gale::python {

/// Adds DistributedMesh to the module, where GALE is built with MPI.
void add_ranks(nanobind::module_& module);

}  // namespace gale::python
