#pragma once

#include <cstdint>

#include <gale/mesh/mesh.hpp>

namespace gale {

/// Which vertices are on the surface: 1 for a vertex (GALE's id) of a triangle that exactly one tetrahedron has, else
/// 0. Vertices without tetrahedra are not on it; nor does a triangle with three or more make one.
///
/// A sweep of link rows on all our threads.
Array<std::uint8_t, HostMemory> surface_vertices(const Mesh& mesh);

}  // namespace gale
