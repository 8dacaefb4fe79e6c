#include "algorithms/named_complex.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

template <class Cell>
bool operator==(const Separatrices<Cell>& a, const Separatrices<Cell>& b) {
  return std::tie(a.sources, a.destinations, a.is_only, a.begin, a.cells) ==
         std::tie(b.sources, b.destinations, b.is_only, b.begin, b.cells);
}

/// Names the simplices of one mesh.
class Namer {
 public:
  explicit Namer(const Mesh& mesh) : mesh_(mesh) {}

  template <std::size_t Size>
  Simplex operator()(const std::array<Id, Size>& vertices) const {
    Simplex simplex;
    for (const Id v : vertices) simplex.push_back(mesh_.vertex_input()(v));
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  }
  Simplex vertex(Id v) const { return (*this)(std::array<Id, 1>{v}); }
  Simplex cell(Id t) const {
    const auto& corners = mesh_.encoded().cells;
    if (mesh_.dimension() == 2) return (*this)(std::array<Id, 3>{corners(t, 0), corners(t, 1), corners(t, 2)});
    return (*this)(std::array<Id, 4>{corners(t, 0), corners(t, 1), corners(t, 2), corners(t, 3)});
  }

 private:
  Mesh mesh_;
};

template <class Cell, class Name>
std::vector<NamedComplex::Path> named_paths(const Separatrices<Cell>& paths, const std::vector<Simplex>& sources,
                                            const std::vector<Simplex>& destinations, const Name& name) {
  std::vector<NamedComplex::Path> named;
  for (Id i = 0; i < paths.count(); ++i) {
    named.push_back({sources.at(paths.sources[i]), destinations.at(paths.destinations.at(i)), {}, true});
    if (!paths.is_only.empty()) named.back().is_only = paths.is_only.at(i) != 0;
    for (const Cell* cell = paths.first(i); cell != paths.last(i); ++cell) named.back().cells.push_back(name(*cell));
  }
  return named;
}

template <class Cell>
std::vector<NamedComplex::Wall> named_walls(const Separatrices<Cell>& walls, const std::vector<Simplex>& sources,
                                            const Namer& name) {
  std::vector<NamedComplex::Wall> named;
  for (Id i = 0; i < walls.count(); ++i) {
    named.push_back({sources.at(walls.sources[i]), {}, {}});
    for (const Cell* cell = walls.first(i); cell != walls.last(i); ++cell) named.back().cells.push_back(name(*cell));
  }
  return named;
}

std::vector<NamedComplex::Wall> named_walls(const AscendingWalls& all, const std::vector<Simplex>& sources,
                                            const Namer& name) {
  auto named = named_walls(all.walls, sources, name);
  std::size_t cell = 0;
  for (auto& wall : named) {
    for (std::size_t i = 0; i < wall.cells.size(); ++i, ++cell) {
      wall.polygons.emplace_back();
      for (Offset at = all.star_begin.at(cell); at < all.star_begin.at(cell + 1); ++at) {
        wall.polygons.back().push_back(name.cell(all.star.at(at)));
      }
    }
  }
  return named;
}

std::vector<Simplex> named_manifolds(const Array<const Id, HostMemory>& manifold, const std::vector<Simplex>& extrema) {
  std::vector<Simplex> named;
  for (const Id place : to_vector(manifold)) named.push_back(place == no_id ? Simplex{} : extrema.at(place));
  return named;
}

template <class T>
void sort_with(std::vector<Simplex>& cells, std::vector<T>& beside) {
  std::vector<std::pair<Simplex, T>> both;
  for (std::size_t i = 0; i < cells.size(); ++i) both.push_back({cells[i], beside.at(i)});
  std::sort(both.begin(), both.end());
  for (std::size_t i = 0; i < cells.size(); ++i) std::tie(cells[i], beside[i]) = both[i];
}

}  // namespace

std::array<Id, 4> NamedComplex::counts() const {
  std::array<Id, 4> counts{};
  for (int d = 0; d < 4; ++d) counts[d] = static_cast<Id>(critical[d].size());
  return counts;
}

NamedComplex named(const MorseSmaleComplex& complex) {
  const Namer name(complex.gradient.mesh());
  const auto vertex = [&](Id v) { return name.vertex(v); };
  NamedComplex all;
  auto& critical = all.critical;
  std::transform(complex.critical.vertices.begin(), complex.critical.vertices.end(), std::back_inserter(critical[0]),
                 vertex);
  for (const auto& edge : complex.critical.edges) critical[1].push_back(name(edge));
  for (const auto& triangle : complex.critical.triangles) critical[2].push_back(name(triangle));
  const int top = complex.critical.dimension;
  for (const Id t : complex.critical.cells) critical[top].push_back(name.cell(t));
  all.descending = named_paths(complex.descending, critical[1], critical[0], vertex);
  all.ascending = named_paths(complex.ascending, critical[top - 1], critical[top], [&](Id t) { return name.cell(t); });
  all.connectors = named_paths(complex.connectors, critical[1], critical[2], name);
  all.descending_walls = named_walls(complex.descending_walls, critical[2], name);
  all.ascending_walls = named_walls(complex.ascending_walls, critical[1], name);
  all.descending_manifold = named_manifolds(complex.descending_manifold.in<HostMemory>(), critical[0]);
  all.ascending_manifold = named_manifolds(complex.ascending_manifold.in<HostMemory>(), critical[top]);
  all.morse_smale_manifold = to_vector(complex.morse_smale_manifold.in<HostMemory>());
  return all;
}

NamedComplex as_defined(NamedComplex complex) {
  complex.morse_smale_manifold.clear();
  for (auto& wall : complex.descending_walls) std::sort(wall.cells.begin(), wall.cells.end());
  for (auto& wall : complex.ascending_walls) {
    for (auto& polygon : wall.polygons) std::sort(polygon.begin(), polygon.end());
    sort_with(wall.cells, wall.polygons);
  }
  return complex;
}

AssertionResult equal(const NamedComplex& a, const NamedComplex& b) {
  if (a.critical != b.critical) return AssertionFailure() << "critical simplices differ";
  if (!(a.descending == b.descending)) return AssertionFailure() << "descending separatrices differ";
  if (!(a.ascending == b.ascending)) return AssertionFailure() << "ascending separatrices differ";
  if (!(a.connectors == b.connectors)) return AssertionFailure() << "saddle connectors differ";
  if (!(a.descending_walls == b.descending_walls)) return AssertionFailure() << "descending walls differ";
  if (!(a.ascending_walls == b.ascending_walls)) return AssertionFailure() << "ascending walls differ";
  if (a.descending_manifold != b.descending_manifold) return AssertionFailure() << "descending manifolds differ";
  if (a.ascending_manifold != b.ascending_manifold) return AssertionFailure() << "ascending manifolds differ";
  if (a.morse_smale_manifold != b.morse_smale_manifold) return AssertionFailure() << "Morse-Smale manifolds differ";
  return AssertionSuccess();
}

AssertionResult equal(const MorseSmaleComplex& a, const MorseSmaleComplex& b) {
  if (a.critical.vertices != b.critical.vertices || a.critical.edges != b.critical.edges ||
      a.critical.triangles != b.critical.triangles || a.critical.cells != b.critical.cells ||
      a.critical.star_begin != b.critical.star_begin || a.critical.star != b.critical.star) {
    return AssertionFailure() << "critical simplices differ";
  }
  if (!(a.descending == b.descending)) return AssertionFailure() << "descending separatrices differ";
  if (!(a.ascending == b.ascending)) return AssertionFailure() << "ascending separatrices differ";
  if (!(a.connectors == b.connectors)) return AssertionFailure() << "saddle connectors differ";
  if (!(a.descending_walls == b.descending_walls)) return AssertionFailure() << "descending walls differ";
  if (!(a.ascending_walls.walls == b.ascending_walls.walls) ||
      a.ascending_walls.star_begin != b.ascending_walls.star_begin ||
      a.ascending_walls.star != b.ascending_walls.star) {
    return AssertionFailure() << "ascending walls differ";
  }
  for (const auto manifold : {&MorseSmaleComplex::descending_manifold, &MorseSmaleComplex::ascending_manifold,
                              &MorseSmaleComplex::morse_smale_manifold}) {
    if (to_vector((a.*manifold).in<HostMemory>()) != to_vector((b.*manifold).in<HostMemory>()))
      return AssertionFailure() << "manifolds differ";
  }
  if (a.morse_smale_manifolds != b.morse_smale_manifolds) return AssertionFailure() << "numbers of manifolds differ";
  return AssertionSuccess();
}

}  // namespace gale::test
