#pragma once

#include <gale/export.hpp>

namespace gale {

/// A type of cell as VTK numbers it.
struct CellType {
  int number;                    ///< VTK's, also in files
  const char* name;              ///< as users of VTK know it
  int dimension;                 ///< 0 to 3
  int points;                    ///< that each has, or 0 if their numbers differ
  const char* plural = nullptr;  ///< what several are called, of the types that split_cells() takes; else nullptr
};

/// nullptr for a number that stands for no type.
GALE_EXPORT const CellType* find_cell_type(int number);

/// VTK's numbers of the types that meshes are made of.
namespace cell_type {
inline constexpr int triangle = 5, triangle_strip = 6, polygon = 7, pixel = 8, quad = 9, tetrahedron = 10, voxel = 11,
                     hexahedron = 12, wedge = 13, pyramid = 14, pentagonal_prism = 15, hexagonal_prism = 16,
                     quadratic_triangle = 22, quadratic_tetrahedron = 24, polyhedron = 42;
}  // namespace cell_type

}  // namespace gale
