#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/io/dataset.hpp>
#include <gale/io/read.hpp>
#include <gale/mesh/cells/cell_types.hpp>

namespace gale::io::detail {

/// The cells of a file, as it has them: nothing in them is checked yet.
struct FileCells {
  PointArray::Values types;         ///< of each, as `CellType::number`
  PointArray::Values ends;          ///< where each ends in `connectivity`; it begins where the one before ends
  PointArray::Values connectivity;  ///< the cells' points; of polyhedra their faces, as gale::Cells has them
};

/// The parts of a mesh as a file has them.
struct MeshParts {
  PointArray::Values points = std::vector<float>();  ///< xyz of each
  FileCells cells{std::vector<std::uint8_t>(), std::vector<std::int64_t>(), std::vector<std::int64_t>()};
  std::vector<PointArray> arrays;
  std::vector<std::string> notices;
};

/// xyz of each of so many points, whose coordinates are one array for each of at most three axes, 0 along others; float
/// if all these are, else double.
PointArray::Values interleaved(const std::vector<PointArray::Values>& axes, std::size_t points);

/// xyz of the points of a rectilinear grid with these places along its axes, float or double.
PointArray::Values points_along(const std::array<std::vector<double>, 3>& axes, bool are_float);

/// The mesh of the cells, in their order: tetrahedra, and what split_cells() makes of other 3D cells; where there are
/// none, triangles, and what split_polygons() makes of other 2D cells. Checks all that it indexes by. Throws
/// gale::Error as these do, for cells that would be split where simplices alone are wanted, for neither tetrahedra nor
/// triangles, and for too many points for ids of 32 bits. Takes what is in `parts`.
Dataset to_mesh(MeshParts& parts, const ReadOptions& options);

/// Points and arrays of the mesh, without its cells, and gives the cells back, as the other ones below are to be
/// split later. Takes what is in `parts`.
Dataset to_points_alone(MeshParts& parts);

/// Splits cells into the tetrahedra of `to`, or its triangles, which may be none, by the ids of its points; of none, by
/// their numbers. Cells of `dimension` count, 2 or 3, or of the highest that there is. Gives it cell_arrays, too, and
/// returns notices. Takes the cells.
std::vector<std::string> split_into(Dataset& to, FileCells& cells, const Array<const GlobalId, HostMemory>& ids,
                                    const ReadOptions& options, std::optional<int> dimension = std::nullopt);

/// The notice about a point array that is left out, and why.
std::string note_array(const std::string& name, const std::string& why);

/// The notice about cell arrays of these names, which aren't read.
std::string note_cell_arrays(const std::vector<std::string>& names);

/// The cells of a structured grid of so many points along each axis, hexahedra or voxels by their type; where one axis
/// has a single point, quads or pixels, and none where two have. Precondition: 32 bits number its points.
FileCells cells_of_grid(const std::array<std::int64_t, 3>& dimensions, int type);

}  // namespace gale::io::detail
