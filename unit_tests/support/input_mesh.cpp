#include "support/input_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "support/voxel_shapes.hpp"

namespace gale::test {

namespace {

using Quad = std::array<Id, 4>;

/// Points of no particular shape, for meshes that are about who touches whom.
std::vector<std::array<double, 3>> scattered_points(Id count) {
  std::mt19937 random(11);
  std::vector<std::array<double, 3>> points(count);
  for (auto& point : points) {
    for (double& coordinate : point) coordinate = random() / 4294967296.0;
  }
  return points;
}

InputMesh scattered(Id vertices, std::vector<Quad> tetrahedra) {
  return {scattered_points(vertices), std::move(tetrahedra)};
}

InputMesh isolated_vertices() { return scattered(9, {{2, 7, 3, 5}, {5, 3, 6, 7}}); }

InputMesh several_components() {
  return scattered(17, {{0, 4, 8, 12}, {4, 8, 12, 16}, {1, 5, 9, 13}, {15, 11, 7, 3}, {3, 11, 7, 2}, {2, 3, 7, 6}});
}

InputMesh seven_on_one_triangle() {
  return scattered(10,
                   {{9, 3, 0, 5}, {1, 3, 9, 5}, {3, 2, 5, 9}, {4, 9, 5, 3}, {5, 6, 3, 9}, {3, 5, 9, 7}, {9, 5, 8, 3}});
}

/// A strip of tetrahedra i, i+1, i+2, i+3, as thin as doubles allow, far from the origin.
InputMesh slivers() {
  InputMesh mesh;
  for (Id i = 0; i < 60; ++i) mesh.points.push_back({1000 + i * 1e-3, 1e-9 * (i % 2), 1e-12 * (i % 3)});
  for (Id i = 0; i + 3 < 60; ++i) mesh.tetrahedra.push_back({i + 2, i, i + 3, i + 1});
  return mesh;
}

InputMesh coincident_points() {
  InputMesh mesh = slivers();
  for (auto& point : mesh.points) point = {0.1, 0.2, 0.3};
  return mesh;
}

/// Any distinct tetrahedra of 60 vertices: edges and triangles with any number of them.
InputMesh random_tetrahedra() {
  std::mt19937 random(7);
  std::set<Quad> distinct;
  while (distinct.size() < 700) {
    Quad quad{};
    for (Id& vertex : quad) vertex = static_cast<Id>(random() % 60);
    std::sort(quad.begin(), quad.end());
    if (std::adjacent_find(quad.begin(), quad.end()) == quad.end()) distinct.insert(quad);
  }
  InputMesh mesh{scattered_points(60), {distinct.begin(), distinct.end()}};
  std::shuffle(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), random);
  return mesh;
}

/// Any distinct tetrahedra of 160 vertices, most of them with two or three of the same five.
InputMesh random_hubs() {
  std::mt19937 random(13);
  std::set<Quad> distinct;
  while (distinct.size() < 1500) {
    Quad quad{};
    for (int i = 0; i < 4; ++i)
      quad[i] = static_cast<Id>(i < 3 && random() % 3 > 0 ? 40 * (random() % 5) : random() % 161);
    std::sort(quad.begin(), quad.end());
    if (std::adjacent_find(quad.begin(), quad.end()) == quad.end()) distinct.insert(quad);
  }
  return scattered(161, {distinct.begin(), distinct.end()});
}

using Maker = std::function<InputMesh()>;

const std::vector<std::pair<std::string, Maker>>& makers() {
  static const std::vector<std::pair<std::string, Maker>> all = {
      {"one_tetrahedron",
       [] {
         return scattered(4, {{2, 0, 3, 1}});
       }},
      {"two_sharing_a_triangle",
       [] {
         return scattered(5, {{4, 1, 3, 2}, {0, 3, 1, 2}});
       }},
      {"two_sharing_an_edge",
       [] {
         return scattered(6, {{4, 1, 5, 2}, {0, 3, 1, 2}});
       }},
      {"two_sharing_a_vertex",
       [] {
         return scattered(7, {{4, 1, 5, 6}, {0, 3, 1, 2}});
       }},
      {"three_on_one_triangle",
       [] {
         return scattered(6, {{0, 1, 2, 3}, {4, 2, 1, 0}, {1, 5, 0, 2}});
       }},
      {"seven_on_one_triangle", seven_on_one_triangle},
      {"the_papers",
       [] {
         return scattered(6, {{0, 1, 2, 3}, {0, 2, 3, 4}, {2, 3, 4, 5}});
       }},
      {"several_components", several_components},
      {"isolated_vertices", isolated_vertices},
      {"slivers", slivers},
      {"coincident_points", coincident_points},
      {"random_tetrahedra", random_tetrahedra},
      {"cone_over_disc_200", [] { return cone_over_disc(200); }},
      {"cone_over_sphere_200", [] { return cone_over_caps(200, 2); }},
      {"cone_over_sphere_2000", [] { return cone_over_caps(2000, 2); }},
      {"cone_over_three_caps_100", [] { return cone_over_caps(100, 3); }},
      {"ring_of_70_around_the_first",
       [] {
         return ring_around_edges(70, {0, 1});
       }},
      {"ring_of_150_around_the_last",
       [] {
         return ring_around_edges(150, {150, 151});
       }},
      {"ring_of_150_around_the_middle",
       [] {
         return ring_around_edges(150, {70, 80});
       }},
      {"ring_of_300_around_first_and_last",
       [] {
         return ring_around_edges(300, {0, 301});
       }},
      {"ring_of_150_around_three",
       [] {
         return ring_around_edges(150, {0, 70, 152});
       }},
      {"random_hubs", random_hubs},
      {"holed_grid_9", [] { return holed_grid(9); }},
      {"ball", [] { return ball(3); }},
      {"solid_torus", [] { return solid_torus(3); }},
      {"thick_shell", [] { return thick_shell(3); }},
#ifdef GALE_ENABLE_VTK
      {"delaunay_600", [] { return delaunay_mesh(600); }},
#endif
  };
  return all;
}

/// The six tetrahedra of a cube along its main diagonal: paths of unit steps from corner 0 to 7, whose bits are x, y,
/// z.
constexpr int freudenthal[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

InputMesh cone(std::vector<std::array<double, 3>> link, const std::vector<std::array<Id, 3>>& triangles) {
  InputMesh mesh;
  mesh.points = std::move(link);
  mesh.points.insert(mesh.points.begin(), {0, 0, 0});
  for (const auto& [a, b, c] : triangles) mesh.tetrahedra.push_back({c + 1, a + 1, 0, b + 1});
  return mesh;
}

std::array<double, 3> on_circle(Id i, Id count, double z) {
  const double angle = 2 * 3.14159265358979 * i / count;
  return {std::cos(angle), std::sin(angle), z};
}

}  // namespace

InputMesh cone_over_disc(Id degree) {
  std::vector<std::array<double, 3>> link;
  std::vector<std::array<Id, 3>> triangles;
  for (Id i = 0; i < degree; ++i) link.push_back(on_circle(i, degree, 1));
  for (Id i = 1; i + 1 < degree; ++i) triangles.push_back({0, i, i + 1});
  return cone(link, triangles);
}

InputMesh cone_over_caps(Id degree, int caps) {
  const Id around = degree - caps;
  std::vector<std::array<double, 3>> link;
  std::vector<std::array<Id, 3>> triangles;
  for (int cap = 0; cap < caps; ++cap) link.push_back({0, 0, 1.0 - 2.0 * cap / (caps - 1)});
  for (Id i = 0; i < around; ++i) {
    link.push_back(on_circle(i, around, 0));
    for (int cap = 0; cap < caps; ++cap) triangles.push_back({cap, caps + i, caps + (i + 1) % around});
  }
  return cone(link, triangles);
}

InputMesh cone_over_strip(Id degree) {
  std::vector<std::array<double, 3>> link;
  std::vector<std::array<Id, 3>> triangles;
  for (Id i = 0; i < degree; ++i) link.push_back(on_circle(i / 2, degree, 1 + i % 2));
  for (Id i = 0; i + 2 < degree; ++i) triangles.push_back({i, i + 1, i + 2});
  return cone(link, triangles);
}

InputMesh ring_around_edges(Id ring, const std::vector<Id>& hubs) {
  InputMesh mesh;
  std::vector<Id> around;
  const auto count = static_cast<Id>(hubs.size());
  for (Id v = 0; v < ring + count; ++v) {
    const auto hub = std::find(hubs.begin(), hubs.end(), v) - hubs.begin();
    if (hub < count) {
      mesh.points.push_back({0, 0, hub - 0.5 * (count - 1)});
    } else {
      mesh.points.push_back(on_circle(static_cast<Id>(around.size()), ring, 0));
      around.push_back(v);
    }
  }
  for (Id i = 0; i < ring; ++i) {
    for (Id hub = 0; hub + 1 < count; ++hub) {
      mesh.tetrahedra.push_back({around[(i + 1) % ring], hubs[hub], around[i], hubs[hub + 1]});
    }
  }
  return mesh;
}

InputMesh holed_grid(Id side) {
  std::mt19937 random(2025);
  std::vector<Id> id(side * side * side);
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<Id>(i);
  std::shuffle(id.begin(), id.end(), random);
  InputMesh mesh;
  mesh.points.resize(id.size());
  const auto at = [&](Id x, Id y, Id z) { return id[(z * side + y) * side + x]; };
  for (Id z = 0; z < side; ++z) {
    for (Id y = 0; y < side; ++y) {
      for (Id x = 0; x < side; ++x) mesh.points[at(x, y, z)] = {double(x), double(y), double(z)};
    }
  }
  for (Id cell = 0; cell < side * side * side; ++cell) {
    const Id x = cell % side, y = cell / side % side, z = cell / side / side;
    if (x + 1 == side || y + 1 == side || z + 1 == side) continue;
    for (const auto& path : freudenthal) {
      if (random() % 3 == 0) continue;
      Quad quad{};
      for (int i = 0; i < 4; ++i) quad[i] = at(x + (path[i] & 1), y + (path[i] >> 1 & 1), z + (path[i] >> 2));
      std::shuffle(quad.begin(), quad.end(), random);
      mesh.tetrahedra.push_back(quad);
    }
  }
  std::shuffle(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), random);
  return mesh;
}

const std::vector<std::string>& mesh_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, make] : makers()) all.push_back(name);
    return all;
  }();
  return names;
}

const InputMesh& mesh_named(const std::string& name) {
  static std::map<std::string, InputMesh> made;
  const auto found = made.find(name);
  if (found != made.end()) return found->second;
  for (const auto& [known, make] : makers()) {
    if (known == name) return made[name] = make();
  }
  throw std::out_of_range("no mesh named " + name);
}

template <class Coordinate>
Points<Coordinate, HostMemory> points_of(const InputMesh& mesh) {
  const Kokkos::View<Coordinate* [3], Kokkos::LayoutRight, HostMemory> points("points", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) points(i, axis) = static_cast<Coordinate>(mesh.points[i][axis]);
  }
  return points;
}

template <class Index>
Tetrahedra<Index, HostMemory> tetrahedra_of(const InputMesh& mesh) {
  const Kokkos::View<Index* [4], Kokkos::LayoutRight, HostMemory> tetrahedra("tetrahedra", mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (int corner = 0; corner < 4; ++corner) tetrahedra(t, corner) = mesh.tetrahedra[t][corner];
  }
  return tetrahedra;
}

template Points<float, HostMemory> points_of(const InputMesh&);
template Points<double, HostMemory> points_of(const InputMesh&);
template Tetrahedra<std::int32_t, HostMemory> tetrahedra_of(const InputMesh&);
template Tetrahedra<std::int64_t, HostMemory> tetrahedra_of(const InputMesh&);

Mesh encode(const InputMesh& mesh, const Segmentation& segmentation) {
  return Mesh(tetrahedra_of<std::int32_t>(mesh), segmentation);
}

}  // namespace gale::test
