#include <gale/algorithms/detail/critical_places.hpp>

#include <algorithm>

namespace gale::detail {

namespace {

template <class Simplex, class Key>
std::vector<std::pair<std::uint64_t, Id>> places_of(const std::vector<Simplex>& simplices, const Key& key) {
  std::vector<std::pair<std::uint64_t, Id>> places;
  places.reserve(simplices.size());
  for (const Simplex& simplex : simplices) places.push_back({key(simplex), static_cast<Id>(places.size())});
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

CriticalPlaces::CriticalPlaces(const CriticalSimplices& critical)
    : vertices_(places_of(critical.vertices, [](Id vertex) { return std::uint64_t(vertex); })),
      edges_(places_of(critical.edges, [](const auto& edge) { return key(edge[0], edge[1]); })),
      tetrahedra_(places_of(critical.tetrahedra, [](Id tetrahedron) { return std::uint64_t(tetrahedron); })) {}

Id CriticalPlaces::find(const Places& places, std::uint64_t key) {
  const auto at = std::lower_bound(places.begin(), places.end(), std::make_pair(key, Id(0)));
  return at != places.end() && at->first == key ? at->second : no_id;
}

}  // namespace gale::detail
