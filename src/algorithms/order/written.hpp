#pragma once

#include <algorithm>

#include <gale/base/types.hpp>

namespace gale::detail {

/// A simplex as users write it: its input vertices, ascending. Of an array of GALE's ids.
template <class Simplex>
Simplex written(const Id* vertex_input, Simplex simplex) {
  for (Id& vertex : simplex) vertex = vertex_input[vertex];
  std::sort(simplex.begin(), simplex.end());
  return simplex;
}

}  // namespace gale::detail
