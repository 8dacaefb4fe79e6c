#pragma once

#include <variant>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/image.hpp>
#include <gale/io/pieces.hpp>
#include <gale/io/read.hpp>

/// The readers, a file a format. Each trusts nothing that a file says: sizes are checked against what the file has
/// before memory is taken, and values against their ranges before they index anything. They throw gale::Error without
/// naming the file.
namespace gale::io::detail {

/// A mesh, or an image whose `select_scalars` and `split_voxels` are still to come.
using Content = std::variant<Dataset, Image>;

/// By the reader of that format.
Content read_content(const InputFile& file, Format format, const ReadOptions& options);

Content read_vtu(const InputFile& file, const ReadOptions& options);
Content read_vti(const InputFile& file, const ReadOptions& options);
Content read_legacy_vtk(const InputFile& file, const ReadOptions& options);
Content read_nifti(const InputFile& file, const ReadOptions& options);
Content read_meta_image(const InputFile& file, const ReadOptions& options);
Content read_nrrd(const InputFile& file, const ReadOptions& options);
Content read_pvtu(const InputFile& file, const ReadOptions& options);
Content read_exodus(const InputFile& file, const ReadOptions& options);
Content read_vtkhdf(const InputFile& file, const ReadOptions& options);

/// What a `.pvtu` names, and some of these pieces as one mesh, which may be empty.
PieceNames names_of_pieces(const InputFile& input);
SomePieces read_some_pieces(const InputFile& input, const PieceNames& some, const ReadOptions& options);

}  // namespace gale::io::detail
