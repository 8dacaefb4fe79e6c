#pragma once

#include <cstdint>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// Which vertices are on the surface: 1 for a vertex (GALE's id) of a triangle that exactly one tetrahedron has, else
/// 0; on triangle meshes 1 for a vertex of an edge that exactly one triangle has. Vertices without cells are not on the
/// surface. Triangles with three or more tetrahedra aren't part of it.
/// Ghosts have 0.
///
/// A sweep of link rows on all our threads.
GALE_EXPORT Array<std::uint8_t, HostMemory> surface_vertices(const Mesh& mesh);

}  // namespace gale
