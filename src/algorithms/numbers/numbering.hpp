#pragma once

#include <array>
#include <string>

#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Numbers simplices of a grid, whole or with a mask: what number_simplices does, by arithmetic. Which cubes are around
/// a vertex says which edges and triangles it is the first vertex of, and in which order; where the others lie from it
/// says which of these is meant.
SimplexNumbers number_on_grid(const Mesh& mesh, const NamedSimplices& named);

/// Throws gale::Error for a vertex that the mesh doesn't have.
template <std::size_t N>
void require_vertices(const Mesh& mesh, const std::array<Id, N>& simplex) {
  for (const Id vertex : simplex) {
    if (vertex >= 0 && vertex < mesh.vertices()) continue;
    throw Error("no vertex " + std::to_string(vertex) + " to number a simplex of: there are " +
                std::to_string(mesh.vertices()));
  }
}

/// Throws gale::Error: the mesh has no simplex of these vertices. `input` has their input ids.
template <std::size_t N>
[[noreturn]] void refuse_simplex(const OtherIds& input, const std::array<Id, N>& simplex) {
  std::string vertices;
  for (const Id vertex : simplex) vertices += ' ' + std::to_string(input[vertex]);
  throw Error("no simplex of the mesh has just the input vertices" + vertices);
}

/// Turns the counts of simplices by their first vertices, one more than there are, into the number of each vertex's
/// first one. Throws gale::Error, with the name of the simplices, for more than ids can number.
inline const Array<Id, HostMemory>& number_first_simplices(const char* name, const Array<Id, HostMemory>& counts) {
  const Offset vertices = static_cast<Offset>(counts.extent(0)) - 1;
  const auto count = [&](Offset i) { return counts(i); };
  require_ids(name, reduce_sum("GALE::sum_simplices", HostExecutionSpace(), vertices, count));
  exclusive_scan("GALE::number_first_simplices", HostExecutionSpace(), vertices, counts, count);
  return counts;
}

}  // namespace gale::detail
