#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/read.hpp>

namespace gale::io {

/// The pieces that a `.pvtu` names.
struct PieceNames {
  std::vector<std::string> sources;  ///< their paths
  std::string global_ids;            ///< the point array that has global ids; empty if there is none
};

/// Reads which pieces `input` names if it is a `.pvtu`; nothing for another one. Throws Error, naming it.
GALE_EXPORT std::optional<PieceNames> piece_names(const std::string& input);

/// Reads some of the pieces of a `.pvtu` as one mesh, which may have no tetrahedra and no points: points that several
/// of them have are there once, in the order in which they occur first, and ghost cells are left out. Throws Error,
/// naming the input.
GALE_EXPORT Dataset read_pieces(const std::string& input, const PieceNames& some, const ReadOptions& options);

}  // namespace gale::io
