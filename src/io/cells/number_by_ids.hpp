#pragma once

#include <cstdint>
#include <vector>

#include <gale/io/cells/cells.hpp>

namespace gale::io::detail {

/// Puts points and their arrays in the order of their ids, which differ, and has cells name them by their new places.
/// Cells are numbers of type int64 that were checked. `ids` are in that order then, too.
void number_points(std::vector<std::int64_t>& ids, MeshParts& parts);

/// Puts cells in the order of their ids; where these are equal, cells stay in the order in which they are. Types, ends
/// and connectivity are of type int64 and were checked.
void number_cells(std::vector<std::int64_t>& ids, Cells& cells);

}  // namespace gale::io::detail
