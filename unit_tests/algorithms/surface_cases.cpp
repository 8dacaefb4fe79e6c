#include "algorithms/surface_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>

namespace gale::test {

testing::internal::ParamGenerator<std::string> surface_names() {
  std::vector<std::string> names;
  for (const auto& one : surfaces()) names.push_back(one.first);
  return testing::ValuesIn(names);
}

std::string surface_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

InputMesh points_of_surface(const InputSurface& surface) { return {surface.points, {}}; }

std::vector<std::vector<Id>> neighbours_on_surface(const InputSurface& surface) {
  std::vector<std::set<Id>> sets(surface.vertices());
  for (const auto& triangle : surface.triangles) {
    for (const Id a : triangle) {
      for (const Id b : triangle) {
        if (a != b) sets[a].insert(b);
      }
    }
  }
  std::vector<std::vector<Id>> neighbours;
  for (const auto& set : sets) neighbours.emplace_back(set.begin(), set.end());
  return neighbours;
}

DiscreteGradient gradient_on_surface(const Mesh& mesh, const std::vector<double>& field) {
  return find_discrete_gradient(VertexOrder(mesh, field.data(), field.size()));
}

bool has_forks(const InputSurface& surface) {
  std::map<std::array<Id, 2>, int> triangles;
  for (auto corners : surface.triangles) {
    std::sort(corners.begin(), corners.end());
    ++triangles[{corners[0], corners[1]}], ++triangles[{corners[0], corners[2]}], ++triangles[{corners[1], corners[2]}];
  }
  return std::any_of(triangles.begin(), triangles.end(), [](const auto& edge) { return edge.second > 2; });
}

InputSurface random_surface(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](Id count) { return static_cast<Id>(random() % static_cast<unsigned>(count)); };
  InputSurface surface = plane(2 + below(7), 2 + below(7));
  const Id vertices = surface.vertices(), one = below(vertices), other = below(vertices);
  std::set<std::array<Id, 3>> triangles = {{0, 1, 2}};
  const auto add = [&](std::array<Id, 3> triangle) {
    std::sort(triangle.begin(), triangle.end());
    if (triangle[0] < triangle[1] && triangle[1] < triangle[2]) triangles.insert(triangle);
  };
  if (seed % 2 == 0) {
    for (Id i = below(3 * vertices); i > 0; --i) add({below(vertices), below(vertices), below(vertices)});
  } else {
    for (auto triangle : surface.triangles) {
      std::replace(triangle.begin(), triangle.end(), one, other);
      if (below(10) != 0) add(triangle);
    }
  }
  surface.triangles.assign(triangles.begin(), triangles.end());
  std::shuffle(surface.triangles.begin(), surface.triangles.end(), random);
  return surface;
}

KnownPlane::KnownPlane(Id n) {
  for (Id y = 0; y < n; ++y) {
    for (Id x = 0; x < n; ++x) {
      auto h = static_cast<std::uint32_t>(y * n + x);
      h ^= h >> 16;
      h *= 0x7feb352dU;
      h ^= h >> 15;
      h *= 0x846ca68bU;
      h ^= h >> 16;
      field.push_back(
          static_cast<float>(std::sin(0.11 * x) * std::cos(0.13 * y) + std::sin(0.05 * x) + 0.05 * h / 4294967296.0));
      surface.points.push_back({double(x), double(y), 0});
      const Id a = y * n + x;
      if (x + 1 == n || y + 1 == n) continue;
      surface.triangles.push_back({a, a + 1, a + n + 1});
      surface.triangles.push_back({a, a + n, a + n + 1});
    }
  }
}

}  // namespace gale::test
