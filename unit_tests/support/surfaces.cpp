#include "support/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace gale::test {

namespace {

using Triangle = std::array<Id, 3>;

/// Puts a surface's ids, triangles and corners in any order.
InputSurface shuffled(InputSurface surface, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Id> id(surface.points.size());
  std::iota(id.begin(), id.end(), 0);
  std::shuffle(id.begin(), id.end(), random);
  auto points = surface.points;
  for (std::size_t i = 0; i < id.size(); ++i) surface.points[id[i]] = points[i];
  for (Triangle& triangle : surface.triangles) {
    for (Id& corner : triangle) corner = id[corner];
    std::shuffle(triangle.begin(), triangle.end(), random);
  }
  std::shuffle(surface.triangles.begin(), surface.triangles.end(), random);
  return surface;
}

std::vector<std::array<double, 3>> points_anywhere(Id count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::vector<std::array<double, 3>> points(count);
  for (auto& point : points) point = {anywhere(random), anywhere(random), anywhere(random)};
  return points;
}

/// Fans of `length` triangles around vertex 0, closed ones.
InputSurface fans(int count, Id length) {
  InputSurface surface{points_anywhere(1 + count * length, 5), {}, 0};
  for (int fan = 0; fan < count; ++fan) {
    const Id first = 1 + fan * length;
    for (Id i = 0; i < length; ++i) surface.triangles.push_back({0, first + i, first + (i + 1) % length});
  }
  surface.euler = 1;
  return surface;
}

InputSurface any_triangles(Id vertices, int count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<Id> any(0, vertices - 1);
  std::set<Triangle> triangles;
  while (static_cast<int>(triangles.size()) < count) {
    Triangle triangle{any(random), any(random), any(random)};
    std::sort(triangle.begin(), triangle.end());
    if (triangle[0] < triangle[1] && triangle[1] < triangle[2]) triangles.insert(triangle);
  }
  InputSurface surface{points_anywhere(vertices, 8), {triangles.begin(), triangles.end()}, 0};
  std::set<std::array<Id, 2>> edges;
  for (const Triangle& t : triangles)
    edges.insert({{t[0], t[1]}}), edges.insert({{t[0], t[2]}}), edges.insert({{t[1], t[2]}});
  surface.euler = vertices - static_cast<int>(edges.size()) + count;
  return surface;
}

std::map<std::string, InputSurface> make_surfaces() {
  std::map<std::string, InputSurface> all;
  all["one triangle"] = {points_anywhere(3, 1), {{2, 0, 1}}, 1};
  all["plane"] = plane(17, 23);
  all["torus"] = torus(19, 14);
  all["sphere"] = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                   {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
                   2};
  InputSurface strip{points_anywhere(9, 2), {}, 0};
  for (Id i = 0; i < 9; ++i) strip.triangles.push_back({i, (i + 1) % 9, (i + 2) % 9});
  all["Moebius strip"] = strip;
  InputSurface book{points_anywhere(7, 3), {}, 1};
  for (Id page = 2; page < 7; ++page) book.triangles.push_back({page, 1, 0});
  all["book of five pages"] = book;
  all["three fans that meet"] = shuffled(fans(3, 9), 4);
  all["hub of 600 triangles"] = shuffled(fans(1, 600), 6);
  all["any triangles"] = any_triangles(60, 400);
  InputSurface lonely = plane(4, 5);
  for (int i = 0; i < 3; ++i) lonely.points.push_back({2.0 + i, 0, 0});
  lonely.euler += 3;
  all["vertices without a triangle"] = shuffled(lonely, 9);
  return all;
}

}  // namespace

const std::map<std::string, InputSurface>& surfaces() {
  static const auto all = make_surfaces();
  return all;
}

InputSurface torus(Id rings, Id sides) {
  constexpr double turn = 6.283185307179586;
  InputSurface surface;
  const auto at = [&](Id ring, Id side) { return ring % rings * sides + side % sides; };
  for (Id ring = 0; ring < rings; ++ring) {
    for (Id side = 0; side < sides; ++side) {
      const double u = turn * ring / rings, v = turn * side / sides, r = 2 + std::cos(v);
      surface.points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const Id a = at(ring, side), b = at(ring + 1, side), c = at(ring, side + 1), d = at(ring + 1, side + 1);
      surface.triangles.push_back({a, b, d});
      surface.triangles.push_back({a, c, d});
    }
  }
  return shuffled(surface, 11);
}

static InputSurface in_order(Id columns, Id rows) {
  InputSurface surface;
  for (Id y = 0; y < rows; ++y) {
    for (Id x = 0; x < columns; ++x) {
      surface.points.push_back({double(x), double(y), 0});
      if (x + 1 == columns || y + 1 == rows) continue;
      const Id a = y * columns + x;
      surface.triangles.push_back({a, a + 1, a + columns + 1});
      surface.triangles.push_back({a, a + columns, a + columns + 1});
    }
  }
  surface.euler = 1;
  return surface;
}

InputSurface plane(Id columns, Id rows) { return shuffled(in_order(columns, rows), 12); }

InputSurface ordered_plane(Id side) { return in_order(side, side); }

std::vector<float> plane_values(Id side) {
  std::vector<float> values;
  for (Id y = 0; y < side; ++y) {
    for (Id x = 0; x < side; ++x) {
      auto hash = static_cast<std::uint32_t>(y * side + x);
      hash ^= hash >> 16;
      hash *= 0x7feb352d;
      hash ^= hash >> 15;
      hash *= 0x846ca68b;
      hash ^= hash >> 16;
      values.push_back(static_cast<float>(std::sin(0.11 * x) * std::cos(0.13 * y) + std::sin(0.05 * x) +
                                          0.05 * hash / 4294967296.0));
    }
  }
  return values;
}

Mesh encode(const InputSurface& surface, int capacity) {
  const Kokkos::View<double* [3], Kokkos::LayoutRight, HostMemory> points("points", surface.points.size());
  const Kokkos::View<Id* [3], Kokkos::LayoutRight, HostMemory> corners("triangles", surface.triangles.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    for (int k = 0; k < 3; ++k) points(i, k) = surface.points[i][k];
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) corners(i, k) = surface.triangles[i][k];
  }
  return Mesh(Triangles<Id, HostMemory>(corners), octree_segmentation(Points<double, HostMemory>(points), capacity));
}

SurfaceOracle::SurfaceOracle(Id vertices, const std::vector<Triangle>& triangles) {
  for (Id v = 0; v < vertices; ++v) simplices_[0].insert({v});
  for (Triangle t : triangles) {
    std::sort(t.begin(), t.end());
    simplices_[2].insert({t[0], t[1], t[2]});
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}}) simplices_[1].insert({a, b});
  }
  for (int dimension = 0; dimension < 3; ++dimension) {
    for (const Simplex& simplex : simplices_[dimension]) {
      for (const Id v : simplex) of_vertex_[dimension][v].insert(simplex);
    }
  }
}

SurfaceOracle::Simplices SurfaceOracle::row(Relation relation, const Simplex& simplex) const {
  const std::size_t size = simplex.size();
  const int entry = entry_dimension(relation);
  Simplices found;
  for (const Id v : simplex) {
    const auto near = of_vertex_[entry].find(v);
    if (near == of_vertex_[entry].end()) continue;
    for (const Simplex& other : near->second) {
      std::size_t common = 0;
      for (const Id corner : other) common += std::count(simplex.begin(), simplex.end(), corner);
      const std::size_t wanted = row_dimension(relation) == entry ? size - 1 : std::min(size, other.size());
      if (common == wanted) found.insert(other);
    }
  }
  if (relation != Relation::VV) return found;
  found.clear();  // vertices are adjacent by edges
  const auto edges = of_vertex_[1].find(simplex[0]);
  if (edges == of_vertex_[1].end()) return found;
  for (const Simplex& edge : edges->second) found.insert({edge[0] == simplex[0] ? edge[1] : edge[0]});
  return found;
}

}  // namespace gale::test
