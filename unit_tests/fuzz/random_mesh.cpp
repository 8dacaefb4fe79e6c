#include "fuzz/random_mesh.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace gale::fuzz {

namespace {

using Tetrahedron = std::array<Id, 4>;

template <class T>
void shuffle(T& all, Random& random) {
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
}

/// `fixed` vertices that all have, 0 and up, and any others.
Tetrahedron around(int fixed, Id vertices, Random& random) {
  std::set<Id> corners;
  for (Id v = 0; v < fixed; ++v) corners.insert(v);
  while (corners.size() < 4) corners.insert(static_cast<Id>(random.below(vertices)));
  Tetrahedron made{};
  std::copy(corners.begin(), corners.end(), made.begin());
  return made;
}

}  // namespace

test::InputMesh random_mesh(Random& random) {
  if (random.one_in(6)) return test::holed_grid(static_cast<Id>(3 + random.below(3)));
  const int fixed = static_cast<int>(random.below(5));  // 4: a chain
  const auto vertices = static_cast<Id>(4 + random.below(random.one_in(4) ? 200 : 12));
  const std::size_t count = 1 + random.below(random.one_in(4) ? 300 : 25);
  std::set<Tetrahedron> made;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<Id>(i % (vertices - 3));
    made.insert(fixed == 4 ? Tetrahedron{first, first + 1, first + 2, first + 3} : around(fixed, vertices, random));
  }
  test::InputMesh mesh;
  mesh.points.resize(vertices);
  for (auto& point : mesh.points) point = {random.below(100) * 0.5, random.below(100) * 0.5, random.below(100) * 0.5};
  std::vector<Id> names(vertices);
  for (Id v = 0; v < vertices; ++v) names[v] = v;
  shuffle(names, random);
  mesh.tetrahedra.assign(made.begin(), made.end());
  shuffle(mesh.tetrahedra, random);
  for (Tetrahedron& tetrahedron : mesh.tetrahedra) {
    for (Id& corner : tetrahedron) corner = names[corner];
    shuffle(tetrahedron, random);
  }
  return mesh;
}

std::vector<double> random_field(std::size_t vertices, Random& random) {
  const std::size_t values = random.one_in(2) ? 3 : 1000;
  std::vector<double> field(vertices);
  for (double& value : field) value = static_cast<double>(random.below(values));
  return field;
}

}  // namespace gale::fuzz
