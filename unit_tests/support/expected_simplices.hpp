#pragma once

#include <array>
#include <vector>

#include <gale/mesh/intervals.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::test {

struct BruteForce;

/// All simplices of a mesh as GALE must number them: vertices and tetrahedra by the mesh's permutations, edges and
/// triangles in lexicographic order of GALE's vertex ids.
struct ExpectedSimplices {
  std::array<std::vector<std::vector<Id>>, 4> vertices;  ///< by dimension and GALE's id; GALE's ids, ascending
  std::array<std::vector<Id>, 4> number;                 ///< by dimension and brute force's number: GALE's id
  std::vector<Id> vertex_begin;                          ///< where each segment's vertices begin

  /// Expects the simplices of the dimensions up to `highest`, and the tetrahedra.
  ExpectedSimplices(const BruteForce& brute_force, const Mesh& mesh, int highest = 3);

  /// The simplices whose lowest vertex a segment holds.
  Interval internal_to(Id segment, int dimension) const;
};

}  // namespace gale::test
