#pragma once

#include <cstdint>

#include <Kokkos_Core.hpp>

#include <gale/export.hpp>

namespace gale::detail {

/// The faces of a 3D cell, by the places of their corners among the cell's points, in their order around, so that
/// normals point outwards. Of a quadratic tetrahedron they are those of the octahedron between its middle points.
struct CellShape {
  static constexpr int most_faces = 8, most_entries = 36, most_triangles = 12;

  std::uint8_t first = 0, end = 0;                ///< the points that faces have
  std::uint8_t faces = 0;                         ///< how many there are
  std::uint8_t face_begin[most_faces + 1] = {0};  ///< where each begins among `corners`, and the end
  std::uint8_t corners[most_entries] = {0};       ///< face after face
};

/// How a type of cell is split.
enum class CellRule : std::uint8_t {
  unknown,             ///< no type has the number
  skip,                ///< cells of lower dimension, which are left out
  refuse,              ///< cells that nobody splits
  simplex,             ///< already a tetrahedron, or a triangle where these are wanted
  cone,                ///< a 3D cell that has a CellShape
  quadratic_cone,      ///< a quadratic tetrahedron: four at its corners, and a cone
  polyhedron,          ///< faces by themselves
  fan,                 ///< a polygon
  pixel,               ///< a quad whose points come by rows
  strip,               ///< triangles that share edges with the next
  quadratic_triangle,  ///< a triangle of six points
};

/// What a kernel knows of all types. Travels with it.
struct CellRules {
  CellRule rule[256] = {};        ///< by VTK's number
  std::uint8_t points[256] = {};  ///< that a cell has, or 0 if their numbers differ
  std::uint8_t shape[256] = {};   ///< which of `shapes`, of cones
  CellShape shapes[8];
};

/// The rules for meshes of cells of so many corners: 4 for tetrahedra, 3 for triangles.
GALE_EXPORT const CellRules& cell_rules(int corners);

}  // namespace gale::detail
