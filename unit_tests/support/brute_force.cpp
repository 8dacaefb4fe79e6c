#include "support/brute_force.hpp"

#include <map>

namespace gale::test {

BruteForce::BruteForce(const InputMesh& mesh)
    : baselines::BruteForce(mesh.vertices(), mesh.tetrahedra),
      vv(rows(Relation::VV)),
      vt(rows(Relation::VT)),
      on_surface(mesh.points.size()) {
  const Table& tetrahedra = rows(Relation::FT);
  for (std::size_t triangle = 0; triangle < tetrahedra.size(); ++triangle) {
    if (tetrahedra[triangle].size() != 1) continue;
    for (const Id v : simplices(2)[triangle]) on_surface[v] = 1;
  }
}

const BruteForce& brute_force_of(const std::string& mesh_name) {
  static std::map<std::string, BruteForce> known;
  const auto found = known.find(mesh_name);
  if (found != known.end()) return found->second;
  return known.emplace(mesh_name, BruteForce(mesh_named(mesh_name))).first->second;
}

}  // namespace gale::test
