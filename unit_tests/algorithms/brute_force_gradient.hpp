#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/input_mesh.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

/// The vertices of a simplex: input ids, ascending.
using Simplex = std::vector<Id>;

/// Each without one of its vertices, the first first; none of a vertex.
std::vector<Simplex> facets_of(const Simplex& simplex);

/// The cells of a mesh, tetrahedra or triangles, in the input's order.
struct CellsOf {
  CellsOf(const InputMesh& mesh);
  CellsOf(const InputSurface& surface);

  Id vertices;
  std::size_t dimension;
  std::vector<Simplex> cells;
};

/// The discrete gradient by the definition of Robins, Wood and Sheppard (2011), from the input alone, with sets and
/// maps.
struct BruteForceGradient {
  BruteForceGradient(const CellsOf& mesh, const std::vector<double>& field);

  std::map<Simplex, Simplex> partner;         ///< of each simplex that has one
  std::array<std::set<Simplex>, 4> critical;  ///< simplices that have none, by dimension
};

/// The gradient of each of fields_on one of `mesh_names()`; found at the first call.
const std::vector<BruteForceGradient>& brute_force_gradients(const std::string& mesh_name);

}  // namespace gale::test
