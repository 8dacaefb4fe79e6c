#include <gale/base/parallel.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using Edge = std::array<Id, 2>;
using Triangle = TriangleVertices;

/// The N vertices that are in both.
template <std::size_t N, class Simplex>
std::array<Id, N> common(const Simplex& a, const Simplex& b) {
  std::array<Id, N> both{};
  std::size_t found = 0;
  for (const Id vertex : a) {
    if (found < N && std::find(b.begin(), b.end(), vertex) != b.end()) both[found++] = vertex;
  }
  return both;
}

/// Appends what precedes each cell of the paths: before the first the saddle where the path begins, before another
/// what `between` says that it and the one before share.
template <class Cell, class Simplex, class Between>
void append_between(const Separatrices<Cell>& paths, const std::vector<Simplex>& saddles, const Between& between,
                    std::vector<Simplex>& simplices) {
  const std::size_t first = simplices.size();
  simplices.resize(first + paths.cells.size());
  parallel_for("GALE::between_cells", HostExecutionSpace(), paths.count(), [&](Offset i) {
    for (Offset k = paths.begin[i]; k < paths.begin[i + 1]; ++k) {
      simplices[first + k] =
          k == paths.begin[i] ? saddles[paths.sources[i]] : between(paths.cells[k - 1], paths.cells[k]);
    }
  });
}

}  // namespace

NamedSimplices named_simplices(const MorseSmaleComplex& complex) {
  NamedSimplices named = {complex.critical.edges, complex.critical.triangles, complex.beyond.vertices};
  const auto edge_of = [](Id a, Id b) { return Edge{a, b}; };
  append_between(complex.descending, complex.critical.edges, edge_of, named.edges);
  append_between(complex.connectors, complex.critical.edges, common<2, Triangle>, named.edges);
  if (complex.critical.dimension == 2) {
    const auto shared_edge = [&](Id a, Id b) {
      return common<2>(detail::corners_of<3>(complex, a), detail::corners_of<3>(complex, b));
    };
    append_between(complex.ascending, complex.critical.edges, shared_edge, named.edges);
    return named;
  }
  const auto shared = [&](Id a, Id b) {
    return common<3>(detail::corners_of(complex, a), detail::corners_of(complex, b));
  };
  append_between(complex.ascending, complex.critical.triangles, shared, named.triangles);
  named.triangles.insert(named.triangles.end(), complex.connectors.cells.begin(), complex.connectors.cells.end());
  return named;
}

}  // namespace gale::outputs
