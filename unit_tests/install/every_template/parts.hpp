#pragma once

#include <cstdint>

#include <gale/mesh/mesh.hpp>

// Two tetrahedra that share a triangle: 5 vertices, 9 edges, 7 triangles.

namespace every_template {

inline constexpr int vertices = 5, edges = 9, triangles = 7, tetrahedra = 2;
inline constexpr double points[vertices][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
inline constexpr int corners[tetrahedra][4] = {{0, 1, 2, 3}, {1, 2, 3, 4}};

/// Stops the program, with what it was, unless it is right.
void expect(bool right, const char* what);

/// The mesh.
gale::Mesh two_tetrahedra();

/// Writes rows of a table to a View of rank 2, wherever that is.
template <class View, class Table>
const View& fill(const View& view, const Table& table) {
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < view.extent(0); ++i) {
    for (std::size_t j = 0; j < view.extent(1); ++j) host(i, j) = static_cast<typename View::value_type>(table[i][j]);
  }
  Kokkos::deep_copy(view, host);
  return view;
}

/// The programs' parts.
void use_meshes();
void use_fields();
void use_sweeps();
void use_ranks();

}  // namespace every_template
