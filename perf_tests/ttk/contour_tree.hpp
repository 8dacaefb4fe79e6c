#pragma once

#include <AbstractTriangulation.h>

#include "module_result.hpp"

namespace gale::perf {

/// The arcs of the contour tree by FTM, from node to node. In a source of its own: nvcc refuses what Boost has for the
/// heaps of FTM.
ModuleResult contour_tree(const Fields& fields, ::ttk::AbstractTriangulation& mesh);

}  // namespace gale::perf
