// Finds the Morse-Smale complex of a field that a program has in std::vectors, and simplifies it.

#include <cstdio>
#include <vector>

#include <gale/algorithms/simplify.hpp>
#include <gale/mesh/make_mesh.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);

  // A strip of tetrahedra, each of four consecutive points, over which a field falls, rises and falls again.
  std::vector<double> points, values;
  std::vector<int> tetrahedra;
  for (int i = 0; i < 12; ++i) {
    points.insert(points.end(), {1.0 * i, 1.0 * (i % 2), 1.0 * (i / 2 % 2)});
    values.push_back(i < 4 ? -i : i < 8 ? i : 16 - 2 * i);
  }
  for (int i = 0; i + 3 < 12; ++i) tetrahedra.insert(tetrahedra.end(), {i, i + 1, i + 2, i + 3});

  const gale::Mesh mesh = gale::make_mesh(points, tetrahedra);
  const gale::VertexOrder order(mesh, values.data(), values.size());
  const gale::DiscreteGradient gradient = gale::find_discrete_gradient(order);
  const gale::MorseSmaleComplex complex = gale::find_morse_smale_complex(gradient);

  for (gale::Id i = 0; i < complex.descending.count(); ++i) {
    std::printf("from a 1-saddle down to a minimum:");
    for (auto vertex = complex.descending.first(i); vertex != complex.descending.last(i); ++vertex)
      std::printf(" %d", mesh.vertex_input()(*vertex));
    std::printf("\n");
  }
  const auto simple = gale::simplify(
      complex, [&](gale::Id vertex) { return values[vertex]; }, 100);
  const auto left = simple.critical.counts();
  std::printf("%d minima, and %d when it is simplified\n", complex.critical.counts()[0], left[0]);
  return left[0] == 1 && simple.critical.euler() == 1 ? 0 : 1;
}
