#pragma once

#include <vector>

#include <gale/algorithms/morse_smale.hpp>

namespace gale::detail {

/// The ascending walls of the 1-saddles for which `is_left` is set: each is made of its own and of those of the
/// 1-saddles that are joined to it, directly or not, by place; a cell that is in several is there once.
AscendingWalls ascending_walls_left(const AscendingWalls& all, const std::vector<std::vector<Id>>& joined,
                                    const std::vector<char>& is_left);

}  // namespace gale::detail
