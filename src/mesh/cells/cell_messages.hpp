#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/cells/cell_shapes.hpp>
#include <gale/mesh/cells/split_cells.hpp>

// What is said of cells: which there are, which were split, and what is wrong with one.

namespace gale::detail {

/// How many cells there are of each type, by VTK's number.
using Census = std::array<Offset, 256>;

/// Counts cells by their types, where these are.
template <class Memory>
Census census_of(const Array<const std::uint8_t, Memory>& types);

/// Says what is wrong with a cell that is bad: it is of that type, from `begin` to `end` in a connectivity of so many
/// entries. `entries` are its own, as far as there are any.
[[noreturn]] void refuse_cell(Offset cell, int number, Offset begin, Offset end, Offset connectivity, Offset points,
                              const CellRules& rules, const std::vector<std::int64_t>& entries);

}  // namespace gale::detail
