#pragma once

#include <gale/base/memory.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// For each vertex (GALE's id) its cell of lowest input id, where the vertex's path to a maximum starts; no_id where it
/// has no cell. In a space that GALE has; waits for nothing.
template <class Space>
Array<Id, MemoryOf<Space>> first_cells(const Space& space, const Mesh& mesh);

}  // namespace gale::detail
