// Finds the critical points of a field on a tetrahedral mesh that the program holds in its own Kokkos Views.

#include <iostream>
#include <variant>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/io/synthetic.hpp>

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);

  const gale::io::Dataset data = gale::io::make_grid(32);
  const auto& field = std::get<std::vector<float>>(data.arrays[0].values);

  const gale::Segmentation segmentation = std::visit(
      [](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        return gale::octree_segmentation(gale::Points<Coordinate, gale::HostMemory>(points));
      },
      data.points);
  const gale::Mesh mesh(gale::Tetrahedra<gale::Id, gale::HostMemory>(data.tetrahedra), segmentation);

  const auto critical = gale::find_critical_points(gale::VertexOrder(mesh, field.data(), field.size()));

  const auto [minima, saddles1, saddles2, maxima, degenerate] = critical.counts;
  std::cout << minima << " minima, " << saddles1 << " 1-saddles, " << saddles2 << " 2-saddles, " << maxima
            << " maxima, " << degenerate << " degenerate\n";
  return minima == 26 && saddles1 == 76 && saddles2 == 88 && maxima == 39 && degenerate == 6 ? 0 : 1;
}
