// How a program that uses TTK takes GALE's triangulation instead of TTK's: the type changes, and Kokkos is initialized.
//     ttk_example
// Finds the critical points of a field on 20^3 points.

#include <ScalarFieldCriticalPoints.h>

#include <cstdio>

#include <gale/base/kokkos.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/ttk/triangulation.hpp>

int main() {
  const Kokkos::ScopeGuard kokkos(gale::initialization_arguments(2));

  // What such a program has: points, cells in TTK's layout, and the ranks of its vertices.
  const gale::io::Dataset data = gale::io::make_grid(20);
  const auto& points = std::get<gale::io::Dataset::Points<float>>(data.points);
  const auto& field = std::get<std::vector<float>>(data.arrays[0].values);
  std::vector<::ttk::LongSimplexId> cells;
  for (std::size_t c = 0; c < data.tetrahedra.extent(0); ++c) {
    cells.push_back(4);
    for (int corner = 0; corner < 4; ++corner) cells.push_back(data.tetrahedra(c, corner));
  }
  std::vector<::ttk::SimplexId> sorted(field.size()), order(field.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = static_cast<::ttk::SimplexId>(i);
  std::sort(sorted.begin(), sorted.end(),
            [&](auto a, auto b) { return std::pair(field[a], a) < std::pair(field[b], b); });
  for (std::size_t i = 0; i < sorted.size(); ++i) order[sorted[i]] = static_cast<::ttk::SimplexId>(i);

  ::ttk::globalDebugLevel_ = 0;
  gale::ttk::Triangulation triangulation;  // was ttk::ExplicitTriangulation
  triangulation.setInputPoints(static_cast<int>(field.size()), points.data());
  triangulation.setInputCells(static_cast<int>(data.tetrahedra.extent(0)), cells.data());

  ::ttk::ScalarFieldCriticalPoints module;
  std::vector<std::pair<::ttk::SimplexId, char>> found;
  module.setDomainDimension(3);
  module.setOutput(&found);
  module.preconditionTriangulation(&triangulation);
  module.execute(order.data(), &triangulation);
  std::printf("%zu critical points\n", found.size());
  return found.empty() ? 1 : 0;
}
