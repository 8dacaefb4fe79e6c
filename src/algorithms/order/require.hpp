#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include <gale/base/error.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Throws gale::Error if `what`, which is of a mesh, is to be used with a structure of another one.
inline void require_same_mesh(const std::string& what, const Mesh& mesh, const Mesh& of_structure) {
  if (mesh == of_structure) return;
  const auto size = [](const Mesh& of) {
    return std::to_string(of.vertices()) + " vertices and " + std::to_string(of.cells()) +
           (of.dimension() == 3 ? " tetrahedra" : " triangles");
  };
  throw Error(what + " is of a mesh of " + size(mesh) + ", the structure of another one of " + size(of_structure));
}

/// Throws gale::Error if a mesh is one rank's part of several, of which `what` can't be found; `instead` says
/// how else.
inline void require_whole_mesh(const std::string& what, const Mesh& mesh, const std::string& instead = "") {
  const int ranks = mesh.exchange().ranks().size();
  if (ranks == 1) return;
  throw SharedError(what + " can't be found of one rank's part of a mesh: it lies on " + std::to_string(ranks) +
                    " ranks" + instead);
}

/// Throws gale::Error for a threshold of persistence that is none.
inline void require_threshold(double threshold) {
  if (threshold >= 0) return;
  std::ostringstream text;
  text << "the persistence " << threshold << " is not 0 or more";
  throw Error(text.str());
}

/// What is wrong with a vertex whose value is NaN.
inline std::string without_value(GlobalId vertex) {
  return "vertex " + std::to_string(vertex) + " has no field value: it is NaN";
}

/// The value at a vertex. Throws gale::Error if it is NaN.
inline double known_value(double value, GlobalId vertex) {
  if (std::isnan(value)) throw Error(without_value(vertex));
  return value;
}

}  // namespace gale::detail
