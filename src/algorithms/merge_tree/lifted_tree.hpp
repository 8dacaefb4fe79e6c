#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/merge_tree/side_keys.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// A forest in which one climbs by powers of two: binary lifting.
template <class Memory>
struct LiftedTree {
  Array<Id, Memory> up;               ///< level by level: of each node that 2^level parents above it; roots their own
  Array<std::uint64_t, Memory> keys;  ///< of the nodes, as the side sees them
  int levels = 0;

  /// The last node from `node` on upwards whose key is at most this one.
  KOKKOS_FORCEINLINE_FUNCTION Id climb(Id node, std::uint64_t key) const {
    const auto count = static_cast<Id>(keys.extent(0));
    for (int level = levels - 1; level >= 0; --level) {
      const Id higher = up(level * count + node);
      if (keys(higher) <= key) node = higher;
    }
    return node;
  }
};

/// Lifts a tree of nodes with a key, as the side sees it, and a parent or none (no_id) each.
template <class Memory>
LiftedTree<Memory> lifted_tree(const std::vector<std::uint64_t>& keys, const std::vector<Id>& parents) {
  const auto count = static_cast<Id>(keys.size());
  std::vector<Id> up(count);
  for (Id node = 0; node < count; ++node) up[node] = parents[node] == no_id ? node : parents[node];
  int levels = 1;
  for (bool goes_on = true; goes_on;) {
    const std::size_t begin = up.size() - static_cast<std::size_t>(count);
    goes_on = false;
    for (Id node = 0; node < count; ++node) {
      const Id half = up[begin + node];
      up.push_back(up[begin + half]);
      goes_on |= up.back() != half;
    }
    if (goes_on) ++levels;
  }
  return {in_memory<Memory>(array_of("GALE::nodes_above", up)), in_memory<Memory>(array_of("GALE::node_keys", keys)),
          levels};
}

}  // namespace gale::detail
