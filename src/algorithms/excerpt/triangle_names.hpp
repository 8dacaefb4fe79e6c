#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/algorithms/separatrices.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

using TrianglesThere = std::vector<Array<TriangleVertices, WorkerMemory>>;

/// The names of vertices, below `count`, that triangles in the workers' memory have: a bit each, 64 a word. Throws
/// OutOfMemory.
std::vector<std::uint64_t> names_passed(const TrianglesThere& triangles, const VertexNames& names, Id count);

/// Has triangles in the workers' memory call their vertices by the numbers of their names, or by these, if there are no
/// numbers. Throws OutOfMemory, and has changed nothing then.
void rename_vertices(const TrianglesThere& triangles, const VertexNames& names, const NumberedSet* numbers);

}  // namespace gale::detail
