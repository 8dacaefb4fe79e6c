#pragma once

#include <utility>
#include <vector>

#include <gale/io/dataset.hpp>
#include <gale/mesh/exchange.hpp>

namespace gale::outputs::detail {

/// Ids as an output has them: in 64 bits on one rank's part of a mesh, else in 32.
inline io::PointArray::Values ids_as(const Exchange& exchange, std::vector<GlobalId> ids) {
  if (exchange.is_of_part()) return ids;
  return std::vector<Id>(ids.begin(), ids.end());
}

}  // namespace gale::outputs::detail
