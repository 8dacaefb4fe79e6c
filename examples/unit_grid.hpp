#pragma once

#include <Kokkos_Core.hpp>

// A mesh for examples.

/// n x n x n points of a unit grid, and six tetrahedra about the diagonal of each of its cells.
template <class Points, class Tetrahedra>
void fill_unit_grid(int n, const Points& points, const Tetrahedra& tetrahedra) {
  using Space = typename Points::execution_space;
  Kokkos::parallel_for(
      "points", Kokkos::RangePolicy<Space>(0, n * n * n), KOKKOS_LAMBDA(int i) {
        points(i, 0) = i % n;
        points(i, 1) = i / n % n;
        points(i, 2) = i / (n * n);
      });
  Kokkos::parallel_for(
      "tetrahedra", Kokkos::RangePolicy<Space>(0, (n - 1) * (n - 1) * (n - 1)), KOKKOS_LAMBDA(int cell) {
        const int m = n - 1, first = (cell / (m * m) * n + cell / m % m) * n + cell % m;
        const int step[3] = {1, n, n * n},
                  order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (int i = 0; i < 6; ++i) {
          int vertex = first;
          tetrahedra(6 * cell + i, 0) = vertex;
          for (int corner = 0; corner < 3; ++corner)
            tetrahedra(6 * cell + i, corner + 1) = vertex += step[order[i][corner]];
        }
      });
}
