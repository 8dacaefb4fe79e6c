#pragma once

#include <array>

#include <gale/algorithms/morse_smale.hpp>

namespace gale::outputs::detail {

/// The vertices of a tetrahedron, all in GALE's ids.
inline std::array<Id, 4> corners_of(const Mesh& mesh, Id tetrahedron) {
  const auto& all = mesh.encoded().tetrahedra;
  return {all(tetrahedron, 0), all(tetrahedron, 1), all(tetrahedron, 2), all(tetrahedron, 3)};
}

/// The vertices of a tetrahedron on a complex's separatrices, which may be beyond the part that its mesh is.
inline std::array<Id, 4> corners_of(const MorseSmaleComplex& complex, Id tetrahedron) {
  const Mesh& mesh = complex.gradient.mesh();
  return tetrahedron < mesh.tetrahedra() ? corners_of(mesh, tetrahedron)
                                         : complex.beyond.corners[tetrahedron - mesh.tetrahedra()];
}

/// Input ids of vertices from GALE's. `input` is `mesh.vertex_input().data()`.
template <std::size_t N>
std::array<Id, N> to_input(const Id* input, std::array<Id, N> simplex) {
  for (Id& vertex : simplex) vertex = input[vertex];
  return simplex;
}

}  // namespace gale::outputs::detail
