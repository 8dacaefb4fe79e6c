#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

/// Options of reading: what of a file is read, and how.
struct ReadOptions {
  /// Images: only voxels with values above this become vertices; without it all with finite values do.
  std::optional<double> above;
  /// Meshes: refuse cells that are neither tetrahedra nor, where there are no 3D cells, triangles, instead of splitting
  /// them into these.
  bool simplices_alone = false;
  /// Images: the array that `above` is about, as `select_scalars` takes it; empty means the file's scalars.
  std::string array;
  /// Files that have several times: the place of the one to read, from 0; without it the first, with a notice.
  std::optional<std::uint64_t> time;
  /// How images, and grid:N and the like, have their cells.
  GridCells grids = GridCells::written;
  /// Headers such as `.mhd` may name data files that aren't in their own folder, nor below it.
  bool outside_files = false;
  /// Files that will be written: those that a header or a `.pvtu` names can't be any of them.
  std::vector<std::string> outputs;
};

/// The points along x, y and z of an input `grid:N` or `plane:N`; nothing for another one. Throws `Error` if N isn't a
/// number, or where a threshold is given.
GALE_EXPORT std::optional<std::array<Id, 3>> grid_points(const std::string& input, const ReadOptions& options);

/// Reads what `input` names; extensions count in either case:
/// - `grid:N`: see `make_grid`; `plane:N`: see `make_plane`; `smooth:N`, `noisy:N`, `ball:N`, `shells:N`, `dense:N`:
/// see
///   `make_synthetic`.
/// - `.vtu .vtk`: an unstructured grid. Its points and numeric point arrays travel as they are, the active scalars
///   first, and its tetrahedra keep their order. Other cells of dimension 3 are split (`split_cells`), with a notice,
///   and those of lower dimension are left out, with another. Where there are no 3D cells, the mesh is one of
///   triangles: 2D cells stay or are split likewise (`split_polygons`). `.vts .vtr`, and `.vtk` of structured and
///   rectilinear grids are meshes of hexahedra or, of one layer, of quads.
/// - `.vtp`, and `.vtk` of such: polygons and strips, as a mesh of triangles. `.stl`: facets, whose corners are merged
///   where their coordinates are equal. `.ply`: faces and strips; numbers of vertices beside x, y and z are point
///   arrays.
///   `.obj .off`: vertices and faces.
/// - `.pvtu`: the pieces that it names, in its folder or below, as one mesh. Their points are the same where their
///   global ids are (`GlobalIds` of `PPointData`), or all coordinates if there are no such; ghost cells are left out.
///   Points are in the order of these ids, cells in that of theirs (`GlobalIds` of `PCellData`), else as they occur.
/// - `.e .ex2 .exo` (Exodus II): the blocks of elements, and nodal variables at a time. `.hdf .vtkhdf`: VTKHDF, a mesh,
///   or an image, at a time. These, and Exodus of NetCDF-4, are HDF5, which the program gale-hdf5-reader reads.
/// - `.vti .nii .nii.gz .mha .mhd .nrrd`, and `.vtk` of structured points: an image, see `split_voxels`. Values are
///   rescaled where the file says so. A NIfTI image keeps the file's voxel order, in the coordinates of its sform, else
///   its qform.
/// - `.pvd .series`: the first of the steps that it names, see `steps_of`.
///
/// Throws `Error` with one line that names `input` and what is wrong with it: no such file, damaged, another kind,
/// neither tetrahedra nor triangles, too large for 32-bit ids. Whatever is in the file, nothing else happens: what it
/// says of sizes is checked against what it has before memory is taken, so that reading takes memory in proportion to
/// what a file holds; values that it lacks are an error. Nothing is printed. Any number of threads may read at the same
/// time.
GALE_EXPORT Dataset read(const std::string& input, const ReadOptions& options = {});

/// One step of a series: what read() reads at a time.
struct Step {
  double time;                        ///< its time, finite
  std::string file;                   ///< the input
  std::optional<std::uint64_t> at{};  ///< its place among the times of a file that has several: ReadOptions::time
};

/// The steps that inputs are. One `.pvd` or `.series` is what it names, by ascending time; one Exodus or VTKHDF file of
/// several times is these, in its order. Else each input is a step, and its time is its place among them, from 0 on.
/// Several inputs aren't opened. Throws `Error` with one line that
/// names the input: a series that can't be read, names no file, one outside its folder (unless `outside_files`) or two
/// at one time; and a series among several inputs.
GALE_EXPORT std::vector<Step> steps_of(const std::vector<std::string>& inputs, const ReadOptions& options = {});

/// The pieces that a `.pvtu` names.
struct PieceNames {
  std::vector<std::string> sources;  ///< their paths
  std::string point_ids;             ///< the point array that has global ids; empty where there is none
  std::string cell_ids;              ///< the cell array that has global ids; empty where there is none
};

/// Some pieces as one mesh, which may have no cells and no points: points that several pieces have are there once, and
/// ghost cells are left out.
struct SomePieces {
  Dataset mesh;  ///< points in the order of their ids, or, without ids, in which they occur first; no tetrahedra yet

  // Cells in the order of their ids, or in which they occur.
  std::vector<std::int64_t> types;         ///< VTK's number of each cell
  std::vector<std::int64_t> ends;          ///< where each ends in `connectivity`
  std::vector<std::int64_t> connectivity;  ///< the cells' points, by their places in the mesh

  // Ids in that order; empty without ids.
  std::vector<std::int64_t> point_ids;  ///< the global ids of points, which differ
  std::vector<std::int64_t> cell_ids;   ///< the global ids of cells
};

/// Reads which pieces `input` names if it is a `.pvtu`; nothing for another one. Throws Error, naming it.
GALE_EXPORT std::optional<PieceNames> piece_names(const std::string& input);

/// Reads some of the pieces of a `.pvtu` as one mesh. Throws Error, naming the input.
GALE_EXPORT SomePieces read_pieces(const std::string& input, const PieceNames& some, const ReadOptions& options);

/// Splits the cells of such pieces into the tetrahedra of their mesh or, of `dimension` 2, into its triangles, by the
/// global ids of its points, so that pieces that others read fit. The dimension is the highest that cells of any piece
/// have. Takes the cells; the notices about them are `notices_of_split`, for all pieces. Throws Error, naming the
/// input.
GALE_EXPORT void split_pieces(const std::string& input, SomePieces& some, const Array<const GlobalId, HostMemory>& ids,
                              const ReadOptions& options, int dimension = 3);

}  // namespace gale::io
