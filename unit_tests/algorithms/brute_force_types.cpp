#include "algorithms/brute_force_types.hpp"

#include <map>
#include <utility>

namespace gale::test {

namespace {

using Side = std::map<Id, Id>;  // neighbour -> some neighbour of its component

Id root(const Side& side, Id v) {
  while (side.at(v) != v) v = side.at(v);
  return v;
}

int components(const Side& side) {
  int count = 0;
  for (const auto& one : side) count += one.first == one.second ? 1 : 0;
  return count;
}

}  // namespace

std::vector<int> brute_force_types(const InputMesh& mesh, const BruteForce& brute_force,
                                   const std::vector<double>& field) {
  const auto below = [&](Id a, Id b) { return std::make_pair(field[a], a) < std::make_pair(field[b], b); };
  std::vector<int> types;
  for (Id v = 0; v < mesh.vertices(); ++v) {
    Side side[2];
    bool surface[2] = {false, false};
    for (const Id u : brute_force.vv[v]) {
      side[below(u, v)][u] = u;
      surface[below(u, v)] |= brute_force.on_surface[u] != 0;
    }
    for (const Id t : brute_force.vt[v]) {
      for (const Id a : mesh.tetrahedra[t]) {
        for (const Id b : mesh.tetrahedra[t]) {
          if (a == v || b == v || below(a, v) != below(b, v)) continue;
          Side& here = side[below(a, v)];
          here[root(here, a)] = root(here, b);
        }
      }
    }
    const auto count = std::make_pair(components(side[1]), components(side[0]));
    int type = 4;
    if (count == std::make_pair(0, 1)) type = 0;
    if (count == std::make_pair(2, 1)) type = 1;
    if (count == std::make_pair(1, 2)) type = 2;
    if (count == std::make_pair(1, 0)) type = 3;
    if (count == std::make_pair(1, 1)) {
      type = 5;
      if (brute_force.on_surface[v] && surface[0] && !surface[1]) type = 1;
      if (brute_force.on_surface[v] && surface[1] && !surface[0]) type = 2;
    }
    types.push_back(type);
  }
  return types;
}

}  // namespace gale::test
