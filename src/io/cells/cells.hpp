#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/io/dataset.hpp>

namespace gale::io::detail {

/// A type of cell as VTK's files number them.
struct CellType {
  int number;
  const char* name;  ///< as users of VTK know it
  int dimension;
  int points;  ///< that each has, or 0 if their numbers differ
};

/// nullptr for a number that stands for no type.
const CellType* find_cell_type(int number);

inline constexpr int tetrahedron_type = 10, voxel_type = 11, hexahedron_type = 12;

/// The cells of a file, as it has them: nothing in them is checked yet.
struct Cells {
  PointArray::Values types;         ///< of each, as `CellType::number`
  PointArray::Values ends;          ///< where each ends in `connectivity`; it begins where the one before ends
  PointArray::Values connectivity;  ///< the cells' points
};

/// The parts of a mesh as a file has them.
struct MeshParts {
  PointArray::Values points = std::vector<float>();  ///< xyz of each
  Cells cells{std::vector<std::uint8_t>(), std::vector<std::int64_t>(), std::vector<std::int64_t>()};
  std::vector<PointArray> arrays;
  std::vector<std::string> notices;
};

/// The mesh of the tetrahedra among the cells, in their order; those of lower dimension are left out with a notice.
/// Checks all that it indexes by. Throws gale::Error: offsets that don't ascend or exceed the connectivity, points that
/// there are not, a cell of dimension 3 that is no tetrahedron unless `tetrahedralize`, no tetrahedra unless it
/// `may_be_empty`, too many for ids of 32 bits. Takes what is in `parts`.
Dataset to_mesh(MeshParts& parts, bool tetrahedralize, bool may_be_empty = false);

/// Throws gale::Error about a cell of dimension 3 that is no tetrahedron.
[[noreturn]] void refuse_solid(std::size_t cell, int type);

/// The notice about a point array that is left out, and why.
std::string note_array(const std::string& name, const std::string& why);

/// The notice about cell arrays of these names, which aren't read.
std::string note_cell_arrays(const std::vector<std::string>& names);

/// The four points of each tetrahedron that the cells of dimension 3 are split into, so that cells which share a face
/// split it alike. The cells are those of a checked mesh, and have types whose number of points is known. Through VTK.
std::vector<std::int32_t> split_cells(const PointArray::Values& points, const std::vector<std::uint8_t>& types,
                                      const std::vector<std::int64_t>& ends,
                                      const std::vector<std::int64_t>& connectivity);

}  // namespace gale::io::detail
