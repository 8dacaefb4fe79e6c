#pragma once

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

}  // namespace gale::io::detail
