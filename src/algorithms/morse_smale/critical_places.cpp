#include <gale/algorithms/morse_smale/critical_places.hpp>

namespace gale::detail {

CriticalPlaces::Table::Table(std::size_t count) {
  std::size_t size = 16;
  while (size < 2 * count) size *= 2;
  slots_.resize(size);
}

CriticalPlaces::CriticalPlaces(const CriticalSimplices& critical)
    : vertices_(critical.vertices.size()), edges_(critical.edges.size()), tetrahedra_(critical.tetrahedra.size()) {
  Id place = 0;
  for (const Id vertex : critical.vertices) vertices_.add(vertex, place++);
  place = 0;
  for (const auto& edge : critical.edges) edges_.add(pair_key(edge[0], edge[1]), place++);
  place = 0;
  for (const Id tetrahedron : critical.tetrahedra) tetrahedra_.add(tetrahedron, place++);
}

}  // namespace gale::detail
