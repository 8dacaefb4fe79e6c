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

class AtomicFile;

namespace detail {

class InputFile;
struct XmlContent;

/// A mesh, or an image whose `select_scalars` and `split_voxels` are still to come.
using Content = std::variant<Dataset, Image>;

/// A reader of a format. Trusts nothing that a file says: sizes are checked against what the file has before memory is
/// taken, and values against their ranges before they index anything. Throws gale::Error without naming the file.
using Reader = Content(const InputFile& file, const ReadOptions& options);

/// Finds the steps that a file is: one for each of its times, or each file that it names. Trusts and throws likewise.
using StepsReader = std::vector<Step>(const InputFile& file, const ReadOptions& options);

/// Writers of a format: of what VTK's XML says as of anything that has sections of arrays; of meshes alone; of the
/// names of a series' files; of tables, whose bytes they return. They write to the temporary file of `to`, and throw
/// gale::Error without the path.
using ContentWriter = void(const AtomicFile& to, const XmlContent& content);
using MeshWriter = void(const AtomicFile& to, const Dataset& mesh, const std::vector<PointArray>& more);
using SeriesWriter = void(const AtomicFile& to, const std::vector<Step>& steps);
using TableWriter = std::string(const std::vector<PointArray>& columns);
using Writer = std::variant<ContentWriter*, MeshWriter*, SeriesWriter*, TableWriter*>;

/// What a file is called that names, with their times, those that stand for `path`, one a step.
using SeriesName = std::string(const std::string& path);

}  // namespace detail

/// The kinds of inputs that files of a format are read as.
enum class Input { none, mesh, volume, series };

/// The kinds of results that are written to files of a format, each a bit: points alone, lines and polygons, lines
/// alone, meshes, pieces of meshes with their global ids, meshes of triangles alone, arrows as points, the names of a
/// series' files, columns of numbers, and what the command draws.
enum Written : unsigned {
  written_points = 1,
  written_surfaces = 2,
  written_lines = 4,
  written_meshes = 8,
  written_pieces = 16,
  written_triangles = 32,
  written_arrows = 64,
  written_series = 128,
  written_tables = 256,
  written_pictures = 512
};

/// A format of files that are read or written.
struct Format {
  const char* name;        ///< e.g. "Exodus II"
  const char* extensions;  ///< in lower case, separated by spaces; they count in either case; results have the last
  Input input;             ///< what its files are read as
  const char* about;       ///< what of its files is read, or nothing, for the documentation
  detail::Reader* reader;  ///< nullptr where none are read

  detail::StepsReader* steps = nullptr;  ///< nullptr where a file is one step

  unsigned written = 0;                  ///< bits of `Written`; 0 if none are
  detail::Writer writer = {};            ///< holds nullptr where pieces have what is written, and of pictures
  detail::SeriesName* series = nullptr;  ///< what names its files of several steps; nullptr: nothing
  const char* pieces = nullptr;          ///< the extension of files that its own name, which have what is written

  /// Whether any of that, bits of `Written`, is written to its files, not to others that they name.
  bool takes(unsigned what) const { return (written & what) != 0 && pieces == nullptr; }
};

/// All formats: what is read and written by its extension, what help and documentation say of it.
GALE_EXPORT const std::vector<Format>& formats();

/// The format of a file by its extension; nullptr for none that is known.
GALE_EXPORT const Format* format_of(const std::string& path);

/// The extensions of the formats that are meant, separated by spaces.
GALE_EXPORT std::string extensions_of(const std::function<bool(const Format& format)>& is_meant);

/// The extensions of files that are read as `input`, separated by spaces.
GALE_EXPORT std::string extensions_of(Input input);

/// The extensions that results of these kinds, bits of `Written`, may have: those of the lowest bit first, of each in
/// the order of the formats. On ranks those of files that name their pieces, where there are such.
GALE_EXPORT std::vector<std::string> extensions_written(unsigned written, bool on_ranks = false);

namespace detail {

/// Whether files can be read: GALE was built with the libraries that this takes, VTK's or the system's. Where it
/// wasn't, libraries/without.cpp stands for the other sources of that folder.
GALE_EXPORT bool reads_files();

}  // namespace detail
}  // namespace gale::io
