#pragma once

#include <array>
#include <variant>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/io/dataset.hpp>

// Values in the types that outputs have them in, and the vertices that they are looked up at.

namespace gale::outputs::detail {

/// Ids as an output has them: in 64 bits on one rank's part of a mesh, else in 32.
inline io::PointArray::Values ids_as(const Exchange& exchange, std::vector<GlobalId> ids) {
  if (exchange.is_of_part()) return ids;
  return std::vector<Id>(ids.begin(), ids.end());
}

/// Values of a field as an output has them: in float if that is the field's type, else in double.
inline io::PointArray::Values values_as(const io::PointArray& field, std::vector<double> values) {
  if (std::holds_alternative<std::vector<float>>(field.values)) return std::vector<float>(values.begin(), values.end());
  return values;
}

/// The rows of `points` that `ids` names.
template <class Points>
Points points_at(const Points& points, const std::vector<Id>& ids) {
  const Points rows("GALE::points_at", ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) rows(i, axis) = points(ids[i], axis);
  }
  return rows;
}

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
