#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/morton_codes.hpp>

namespace gale::detail {

/// First positions of the octree's leaves among sorted Morton codes, ascending, the first being 0: cells of at most
/// `capacity` codes whose parent cell has more. A run of equal codes longer than that is cut every `capacity` codes.
template <class Space>
std::vector<Id> octree_leaves(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& sorted_codes,
                              int capacity);

/// Joins consecutive leaves while together they hold at most `capacity` codes, from the first on. Returns where each
/// segment begins, and then `count`, the number of all codes.
std::vector<Id> merge_leaves(const std::vector<Id>& leaves, Id count, int capacity);

}  // namespace gale::detail
