#pragma once

#include <string>

#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Throws gale::Error if a mesh is one rank's part of several, of which `what` can't be found.
inline void require_whole_mesh(const std::string& what, const Mesh& mesh) {
  const int ranks = mesh.exchange().ranks().size();
  if (ranks == 1) return;
  throw SharedError(what + " can't be found of one rank's part of a mesh: it lies on " + std::to_string(ranks) +
                    " ranks");
}

}  // namespace gale::detail
