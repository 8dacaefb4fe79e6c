#pragma once

#include <string>

#include <gale/base/error.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Throws gale::Error if a mesh is one rank's part, of which `what` can't be found alone.
inline void require_whole_mesh(const std::string& what, const Mesh& mesh) {
  if (mesh.owned_vertices() == mesh.vertices()) return;
  throw Error(what + " can't be found of one rank's part of a mesh: " +
              std::to_string(mesh.vertices() - mesh.owned_vertices()) + " of its " + std::to_string(mesh.vertices()) +
              " vertices are ghosts");
}

}  // namespace gale::detail
