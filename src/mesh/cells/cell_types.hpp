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
inline constexpr int triangle = 5;                ///< three corners
inline constexpr int triangle_strip = 6;          ///< a triangle for each three points in a row
inline constexpr int polygon = 7;                 ///< corners around it
inline constexpr int pixel = 8;                   ///< four corners, x fastest
inline constexpr int quad = 9;                    ///< four corners around it
inline constexpr int tetrahedron = 10;            ///< four corners
inline constexpr int voxel = 11;                  ///< eight corners, x fastest
inline constexpr int hexahedron = 12;             ///< the bottom quad, then the top one
inline constexpr int wedge = 13;                  ///< two triangles
inline constexpr int pyramid = 14;                ///< a quad, then the apex
inline constexpr int pentagonal_prism = 15;       ///< two pentagons
inline constexpr int hexagonal_prism = 16;        ///< two hexagons
inline constexpr int quadratic_triangle = 22;     ///< three corners, then the middles of its edges
inline constexpr int quadratic_tetrahedron = 24;  ///< four corners, then the middles of its edges
inline constexpr int polyhedron = 42;  ///< the number of faces, then each as the number of its points and these
}  // namespace cell_type

}  // namespace gale
