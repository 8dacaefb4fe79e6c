#pragma once

#include <string>

#include <gale/base/error.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Throws gale::Error if `what`, which is of a mesh, is to be used with a structure of another one.
inline void require_same_mesh(const std::string& what, const Mesh& mesh, const Mesh& of_structure) {
  if (mesh == of_structure) return;
  const auto size = [](const Mesh& of) {
    return std::to_string(of.vertices()) + " vertices and " + std::to_string(of.tetrahedra()) + " tetrahedra";
  };
  throw Error(what + " is of a mesh of " + size(mesh) + ", the structure of another one of " + size(of_structure));
}

}  // namespace gale::detail
