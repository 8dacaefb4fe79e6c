#include <gale/algorithms/detail/gradient_store.hpp>

#include <algorithm>

namespace gale::detail {

namespace {

/// All parts' members, sorted by `key`, which is unique.
template <class T, class Key>
std::vector<T> gathered(const std::vector<CriticalSimplices>& parts, std::vector<T> CriticalSimplices::*member, const Key& key) {
  std::vector<std::pair<decltype(key(T())), T>> keyed;
  for (const auto& part : parts) {
    for (const T& simplex : part.*member) keyed.push_back({key(simplex), simplex});
  }
  std::sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<T> all;
  all.reserve(keyed.size());
  for (const auto& [sorted_by, simplex] : keyed) all.push_back(simplex);
  return all;
}

}  // namespace

GradientStore::GradientStore(const Mesh& mesh_, const VertexOrder& order_, int consumers)
    : mesh(mesh_),
      order(order_),
      vertex_successor(allocate<Array<Id, HostMemory>>("GALE::vertex_successor", mesh.vertices())),
      tetrahedron_successor(allocate<Array<Id, HostMemory>>("GALE::tetrahedron_successor", mesh.tetrahedra())),
      pairs(mesh.vertices(), consumers),
      found_(consumers) {}

void GradientStore::finish() {
  const Id* const vertex_input = mesh.vertex_input().data();
  const Id* const tetrahedron_input = mesh.tetrahedron_input().data();
  const auto sorted = [=](auto simplex) {
    for (Id& vertex : simplex) vertex = vertex_input[vertex];
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  };
  critical.vertices = gathered(found_, &CriticalSimplices::vertices, [=](Id vertex) { return vertex_input[vertex]; });
  critical.edges = gathered(found_, &CriticalSimplices::edges, sorted);
  critical.triangles = gathered(found_, &CriticalSimplices::triangles, sorted);
  critical.tetrahedra = gathered(found_, &CriticalSimplices::tetrahedra, [=](Id tetrahedron) { return tetrahedron_input[tetrahedron]; });
  found_.clear();
}

std::size_t GradientStore::bytes() const {
  return (vertex_successor.extent(0) + tetrahedron_successor.extent(0)) * sizeof(Id) + pairs.bytes();
}

}  // namespace gale::detail
