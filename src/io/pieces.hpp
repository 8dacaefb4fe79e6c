#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/read.hpp>

namespace gale::io {

/// The pieces that a `.pvtu` names.
struct PieceNames {
  std::vector<std::string> sources;  ///< their paths
  std::string point_ids;             ///< the point array that has global ids; empty where there is none
  std::string cell_ids;              ///< the cell array that has global ids; empty where there is none
};

/// Some pieces as one mesh, which may have no tetrahedra and no points: points that several pieces have are there
/// once, and ghost cells are left out.
struct SomePieces {
  Dataset mesh;  ///< points and tetrahedra in the order of their ids, or, without ids, in which they occur first

  // In that order; empty without ids.
  std::vector<std::int64_t> point_ids;        ///< the global ids of points, which differ
  std::vector<std::int64_t> tetrahedron_ids;  ///< the global ids of tetrahedra
};

/// Reads which pieces `input` names if it is a `.pvtu`; nothing for another one. Throws Error, naming it.
GALE_EXPORT std::optional<PieceNames> piece_names(const std::string& input);

/// Reads some of the pieces of a `.pvtu` as one mesh. Throws Error, naming the input.
GALE_EXPORT SomePieces read_pieces(const std::string& input, const PieceNames& some, const ReadOptions& options);

}  // namespace gale::io
