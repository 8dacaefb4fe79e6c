#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/image.hpp>
#include <gale/io/read.hpp>

namespace gale::io {
namespace detail {

class InputFile;

/// A mesh, or an image whose `select_scalars` and `split_voxels` are still to come.
using Content = std::variant<Dataset, Image>;

/// A reader of a format. Trusts nothing that a file says: sizes are checked against what the file has before memory is
/// taken, and values against their ranges before they index anything. Throws gale::Error without naming the file.
using Reader = Content(const InputFile& file, const ReadOptions& options);

/// Finds the steps that a file is: one for each of its times, or each file that it names. Trusts and throws likewise.
using StepsReader = std::vector<Step>(const InputFile& file, const ReadOptions& options);

}  // namespace detail

/// The kinds of inputs that files of a format are read as.
enum class Input { none, mesh, volume, series };

/// The kinds of results that are written to files of a format, each a bit: points alone, lines and polygons, lines
/// alone, meshes, pieces of meshes with their global ids, meshes of triangles alone, and results of several times, of
/// which each may be such a file or not.
enum Written : unsigned {
  written_points = 1,
  written_surfaces = 2,
  written_lines = 4,
  written_meshes = 8,
  written_pieces = 16,
  written_triangles = 32,
  written_series = 64,
  written_steps = 128
};

/// A format of files that are read or written.
struct Format {
  const char* name;        ///< e.g. "Exodus II"
  const char* extensions;  ///< in lower case, separated by spaces; they count in either case
  Input input;             ///< what its files are read as
  unsigned written;        ///< bits of `Written`; 0 if none are
  bool of_pieces;          ///< its files name others, which have what is written
  const char* about;       ///< what of its files is read, or nothing, for the documentation
  detail::Reader* reader;  ///< nullptr where none are read

  detail::StepsReader* steps = nullptr;  ///< nullptr where a file is one step

  /// Whether any of that, bits of `Written`, is written to its files, not to others that they name.
  bool takes(unsigned what) const { return (written & what) != 0 && !of_pieces; }
};

/// All formats: what is read and written by its extension, what help and documentation say of it.
GALE_EXPORT const std::vector<Format>& formats();

/// The format of a file by its extension; nullptr for none that is known.
GALE_EXPORT const Format* format_of(const std::string& path);

/// The extensions of the formats that are meant, separated by spaces.
GALE_EXPORT std::string extensions_of(const std::function<bool(const Format& format)>& is_meant);

/// The extensions of files that are read as `input`, separated by spaces.
GALE_EXPORT std::string extensions_of(Input input);

namespace detail {

/// Whether files can be read: GALE was built with the libraries that this takes, VTK's or the system's. Where it
/// wasn't, libraries/without.cpp stands for the other sources of that folder.
GALE_EXPORT bool reads_files();

}  // namespace detail
}  // namespace gale::io
