#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>

namespace gale::test {

/// A mesh of triangles as users hand it over: input ids, triangles and their corners in any order.
struct InputSurface {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<Id, 3>> triangles;
  int euler = 0;  ///< vertices - edges + triangles, where it is known beforehand; isolated vertices count

  Id vertices() const { return static_cast<Id>(points.size()); }
};

/// Surfaces that tests loop over: one triangle, a plane, a sphere, a torus, a Moebius strip, a book of five pages, fans
/// that meet in a vertex, a hub of 600 triangles, any triangles at all, and some vertices without a triangle.
const std::map<std::string, InputSurface>& surfaces();

/// A torus of `rings` times `sides` vertices, or a plane of so many, shuffled.
InputSurface torus(Id rings, Id sides);
InputSurface plane(Id columns, Id rows);

/// `plane:side` of the command: in order, and its field.
InputSurface ordered_plane(Id side);
std::vector<float> plane_values(Id side);

/// GALE's mesh, of segments of at most `capacity` vertices.
Mesh encode(const InputSurface& surface, int capacity);

/// What touches what among some triangles, from sets of their vertices: slow and simple, and without any code of
/// GALE's. A simplex is its vertices, ascending.
class SurfaceOracle {
 public:
  using Simplex = std::vector<Id>;
  using Simplices = std::set<Simplex>;

  SurfaceOracle(Id vertices, const std::vector<std::array<Id, 3>>& triangles);

  /// All simplices of a dimension 0 to 2.
  const Simplices& simplices(int dimension) const { return simplices_[dimension]; }

  /// The simplices that the row of a simplex has.
  Simplices row(Relation relation, const Simplex& simplex) const;

 private:
  std::array<Simplices, 3> simplices_;
  std::map<Id, Simplices> of_vertex_[3];  ///< by dimension: the simplices that have a vertex
};

}  // namespace gale::test
