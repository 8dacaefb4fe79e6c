#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/read.hpp>

namespace gale::io {

/// Points by themselves, such as critical points, with their arrays.
struct PointSet {
  Dataset::Positions points;       ///< three coordinates each
  std::vector<PointArray> arrays;  ///< with values for each point
};

/// Lines and polygons between points, with arrays of both.
struct Surface {
  /// The k-th has the points `points[begin[k]]` to `points[begin[k + 1] - 1]`, in their order along it.
  struct Cells {
    std::vector<std::int64_t> begin{0};  ///< one more than there are cells
    std::vector<std::int32_t> points;    ///< places in Surface::points
  };

  Dataset::Positions points;             ///< three coordinates each
  std::vector<PointArray> point_arrays;  ///< with values for each point
  Cells lines;                           ///< paths, of two points at least
  Cells polygons;                        ///< three points at least, in their order around
  std::vector<PointArray> cell_arrays;   ///< a value for each line, then for each polygon
};

/// The name of the array that has points' global ids, as others have it.
inline constexpr const char* global_point_ids = "GlobalPointIds";

/// The name of the array that has cells' global ids.
inline constexpr const char* global_cell_ids = "GlobalCellIds";

/// Where something is written: a path, or the temporary file of an AtomicFile, whose path decides then, and which the
/// caller commits: so several files appear together (`AtomicFiles`).
class Target {
 public:
  Target(const std::string& path) : path_(path) {}  ///< a file that appears there
  Target(const char* path) : path_(path) {}         ///< a file that appears there
  Target(const AtomicFile& file)
      : path_(file.path()), file_(&file) {}  ///< one that the caller commits, and outlives it

  /// The path of the file, which names it in errors.
  const std::string& path() const { return path_; }

  /// The file that the caller commits, or nullptr.
  const AtomicFile* file() const { return file_; }

 private:
  std::string path_;
  const AtomicFile* file_ = nullptr;
};

/// Writes `points` to a `.vtp` or `.vtkhdf`, each as a vertex cell, in their order.
///
/// Here and below: of two arrays of one name the later is written. The file appears complete or not at all
/// (`AtomicFile`). Throws `Error` with one line that names `path` and the reason: an array of the wrong length, a
/// directory that is missing or not writable, a full disk; for a `.vtkhdf` an array whose name HDF5 hasn't: with a '/',
/// '.', or of more than 60,000 bytes.
GALE_EXPORT void write_points(const Target& to, const PointSet& points);

/// Writes `surface` to a `.vtp` or `.vtkhdf`.
GALE_EXPORT void write_surface(const Target& to, const Surface& surface);

/// Writes the lines of `lines`, without its polygons, to a `.vtu` or `.vtkhdf`: for what others give as an unstructured
/// grid of lines, such as persistence diagrams.
GALE_EXPORT void write_lines(const Target& to, const Surface& lines);

/// Writes points, tetrahedra or triangles (a grid's, too), and arrays of `mesh` in their order to a `.vtu`, `.vtkhdf`
/// or (binary, legacy) `.vtk`, or triangles to a `.vtp`, by the extension; then those of `more`, so that results need
/// not be copied into the mesh first.
GALE_EXPORT void write_mesh(const Target& to, const Dataset& mesh, const std::vector<PointArray>& more = {});

/// Writes one rank's part of a mesh, which may be empty, to a `.vtu`: its own cells with all their vertices. Its point
/// arrays have GlobalPointIds, its cell arrays GlobalCellIds.
GALE_EXPORT void write_piece(const Target& to, const Dataset& piece);

/// Writes a `.pvtp`, or for meshes (below) a `.pvtu`, that names `pieces`, files in the same folder, to the temporary
/// file of `file`. `like` has the types of coordinates and arrays that each of them has, the arrays in the same order;
/// its points don't matter.
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const PointSet& like);

/// Writes the `.pvtp` of pieces that are surfaces.
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Surface& like);

/// Writes the `.pvtu` of pieces that are meshes.
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Dataset& like);

/// Writes a `.pvd` or a `.series` that names files in the same folder, each with its time, to the temporary file of
/// `file`. ParaView reads files of XML through a `.pvd`, VTKHDF through a `.vtkhdf.series`.
/// Throws gale::Error for other names.
GALE_EXPORT void write_series(const AtomicFile& file, const std::vector<Step>& steps);

/// Columns of one number a row as comma-separated values, behind a line of their names. Numbers are written such that
/// they are read back as they are.
GALE_EXPORT std::string to_csv(const std::vector<PointArray>& columns);

/// The content of an .npz, which numpy.load reads: an array for each column, of its name and type. Throws Error where
/// that is 4 GiB or more.
GALE_EXPORT std::string to_npz(const std::vector<PointArray>& columns);

}  // namespace gale::io
