#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gale/io/cells/cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>

// Common parts of `.vtu` and of the `.pvtu` that names several of them.

namespace gale::io::detail {

/// The pieces of a `.vtu`.
std::vector<const XmlElement*> pieces_of(const XmlFile& file);

/// Points, cells and point arrays of one of them. Throws gale::Error for what the file lacks.
MeshParts read_piece(const XmlFile& file, const XmlElement& piece);

/// The values of a cell array of one component, which read_xml() was told of. Nothing if there is no such array.
std::optional<PointArray::Values> read_cell_array(const XmlFile& file, const XmlElement& piece,
                                                  const std::string& name);

/// The pieces that a `.pvtu` names, and some of these as one mesh, which may be empty.
PieceNames names_of_pieces(const InputFile& input);
SomePieces read_some_pieces(const InputFile& input, const PieceNames& some, const ReadOptions& options);

}  // namespace gale::io::detail
