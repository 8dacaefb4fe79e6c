#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

class AtomicFile;

/// Points by themselves, such as critical points, with their arrays.
struct PointSet {
  Dataset::Positions points;
  std::vector<PointArray> arrays;
};

/// Lines and polygons between points, with arrays of both.
struct Surface {
  /// The k-th has the points `points[begin[k]]` to `points[begin[k + 1] - 1]`, in their order along it.
  struct Cells {
    std::vector<std::int64_t> begin{0};
    std::vector<std::int32_t> points;
  };

  Dataset::Positions points;
  std::vector<PointArray> point_arrays;
  Cells lines, polygons;
  std::vector<PointArray> cell_arrays;  ///< a value for each line, then for each polygon
};

/// The names of arrays that have global ids, of points and of cells, as others have them.
inline constexpr const char* global_point_ids = "GlobalPointIds";
inline constexpr const char* global_cell_ids = "GlobalCellIds";

/// One rank's part of a mesh that lies on several. Its point arrays have GlobalPointIds, its cell arrays GlobalCellIds.
struct MeshPiece {
  Dataset mesh;
  std::vector<PointArray> cell_arrays;  ///< a value for each tetrahedron
};

/// Writes `points` to a `.vtp`, each as a vertex cell, in their order.
///
/// Here and below: of two arrays of one name the later is written. The file appears complete or not at all
/// (`AtomicFile`). Throws `Error` with one line that names `path` and the reason: an array of the wrong length, a
/// directory that is missing or not writable, a full disk.
GALE_EXPORT void write_points(const std::string& path, const PointSet& points);

/// Here and below: writes to the temporary file of `file`, whose path decides, and leaves it to the caller to commit
/// it: so several files appear together (`AtomicFiles`).
GALE_EXPORT void write_points(const AtomicFile& file, const PointSet& points);

/// Writes a `.pvtp`, or of meshes a `.pvtu`, that names `pieces`, files in the same folder, to the temporary file of
/// `file`. `like` has the types of coordinates and arrays that each of them has, the arrays in the same order; its
/// points don't matter.
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const PointSet& like);
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Surface& like);
GALE_EXPORT void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const MeshPiece& like);

/// Writes one to the temporary file of a `.vtu`. It may be empty.
GALE_EXPORT void write_piece(const AtomicFile& file, const MeshPiece& piece);

/// Writes `surface` to a `.vtp`.
GALE_EXPORT void write_surface(const std::string& path, const Surface& surface);
GALE_EXPORT void write_surface(const AtomicFile& file, const Surface& surface);

/// Writes the lines of `lines`, without its polygons, to the temporary file of a `.vtu`: for what others give as an
/// unstructured grid of lines, such as persistence diagrams.
GALE_EXPORT void write_lines(const AtomicFile& file, const Surface& lines);

/// Writes points, tetrahedra and arrays of `mesh` in their order to a `.vtu` or (binary, legacy) `.vtk`, by the
/// extension; then those of `more`, so that results need not be copied into the mesh first.
GALE_EXPORT void write_mesh(const std::string& path, const Dataset& mesh, const std::vector<PointArray>& more = {});
GALE_EXPORT void write_mesh(const AtomicFile& file, const Dataset& mesh, const std::vector<PointArray>& more = {});

}  // namespace gale::io
