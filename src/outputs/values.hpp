#pragma once

#include <algorithm>
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

/// The vertices of a cell, all in GALE's ids: of a tetrahedron, or the first three of a triangle.
template <std::size_t N = 4>
std::array<Id, N> corners_of(const CellReader& cells, Id cell) {
  const Quad all = cells(cell);
  std::array<Id, N> corners;
  for (std::size_t k = 0; k < N; ++k) corners[k] = all[static_cast<int>(k)];
  return corners;
}

/// Whether a simplex has a vertex: compares all, which is faster than to stop at the first.
template <std::size_t N>
bool has(const std::array<Id, N>& simplex, Id vertex) {
  bool found = false;
  for (const Id one : simplex) found |= one == vertex;
  return found;
}

/// Input ids of vertices from GALE's. `input` is `mesh.vertices_in_input()`.
template <std::size_t N>
std::array<Id, N> to_input(const OtherIds& input, std::array<Id, N> simplex) {
  for (Id& vertex : simplex) vertex = input[vertex];
  return simplex;
}

}  // namespace gale::outputs::detail
