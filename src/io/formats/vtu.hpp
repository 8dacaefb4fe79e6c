#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gale/io/cells/cells.hpp>
#include <gale/io/formats/readers.hpp>
#include <gale/io/formats/xml_file.hpp>

// What `.vtu` and the `.pvtu` that names several of them have in common.

namespace gale::io::detail {

/// The pieces of a `.vtu`.
std::vector<const XmlElement*> pieces_of(const XmlFile& file);

/// Points, cells and point arrays of one of them. Throws gale::Error for what the file lacks.
MeshParts read_piece(const XmlFile& file, const XmlElement& piece);

/// What VTK's writers say of each cell in the array vtkGhostType: its bit 1 is set where another piece has the cell,
/// too. Nothing if there is no such array.
std::optional<PointArray::Values> read_ghosts(const XmlFile& file, const XmlElement& piece);

/// The points of these pieces, each once, and their cells without ghosts. Throws gale::Error, naming the piece.
MeshParts read_pieces(const InputFile& input, const PieceNames& names, const ReadOptions& options);

}  // namespace gale::io::detail
