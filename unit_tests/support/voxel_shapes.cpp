#include "support/voxel_shapes.hpp"

#include <algorithm>
#include <map>
#include <random>

namespace gale::test {

namespace {

using Point = std::array<Id, 3>;

/// Every path from corner 0 to corner 7 of a cube that takes one step in each direction.
std::vector<std::array<Point, 4>> tetrahedra_of_cube(const Point& corner) {
  std::vector<std::array<Point, 4>> tetrahedra;
  Point axes = {0, 1, 2};
  do {
    std::array<Point, 4> path = {corner, corner, corner, corner};
    for (int step = 0; step < 3; ++step) {
      for (int i = step + 1; i < 4; ++i) ++path[i][axes[step]];
    }
    tetrahedra.push_back(path);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return tetrahedra;
}

bool in_middle(Id side, Id x) { return x >= side / 3 && x < side - side / 3; }

}  // namespace

InputMesh voxels(Id cubes_x, Id cubes_y, Id cubes_z, const std::function<bool(Id x, Id y, Id z)>& kept) {
  std::vector<std::array<Point, 4>> tetrahedra;
  for (Id z = 0; z < cubes_z; ++z) {
    for (Id y = 0; y < cubes_y; ++y) {
      for (Id x = 0; x < cubes_x; ++x) {
        if (!kept(x, y, z)) continue;
        for (const auto& path : tetrahedra_of_cube({x, y, z})) tetrahedra.push_back(path);
      }
    }
  }
  std::mt19937 random(77);
  std::shuffle(tetrahedra.begin(), tetrahedra.end(), random);
  std::map<Point, Id> id;
  InputMesh mesh;
  for (auto& path : tetrahedra) {
    std::shuffle(path.begin(), path.end(), random);
    mesh.tetrahedra.emplace_back();
    for (int corner = 0; corner < 4; ++corner) {
      const auto [entry, is_new] = id.emplace(path[corner], static_cast<Id>(id.size()));
      if (is_new) mesh.points.push_back({double(path[corner][0]), double(path[corner][1]), double(path[corner][2])});
      mesh.tetrahedra.back()[corner] = entry->second;
    }
  }
  return mesh;
}

InputMesh ball(Id side) {
  return voxels(side, side, side, [](Id, Id, Id) { return true; });
}

InputMesh solid_torus(Id side) {
  return voxels(side, side, side / 3, [side](Id x, Id y, Id) { return !in_middle(side, x) || !in_middle(side, y); });
}

InputMesh thick_shell(Id side) {
  return voxels(side, side, side,
                [side](Id x, Id y, Id z) { return !in_middle(side, x) || !in_middle(side, y) || !in_middle(side, z); });
}

}  // namespace gale::test
