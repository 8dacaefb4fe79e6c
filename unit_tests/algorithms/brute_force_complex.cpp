#include "algorithms/brute_force_complex.hpp"

#include <algorithm>

namespace gale::test {

namespace {

/// Follows V-paths up and down.
class Paths {
 public:
  Paths(const CellsOf& mesh, const BruteForceGradient& gradient) : gradient_(gradient), cells_(mesh.cells) {
    for (const Simplex& cell : mesh.cells) {
      for (const Simplex& facet : facets_of(cell)) {
        cells_of_[facet].push_back(cell);
        for (const Simplex& edge : facets_of(facet)) triangles_of_[edge].insert(facet);
      }
    }
  }

  /// All cells and those of a facet of cells, as the input has them.
  const std::vector<Simplex>& cells() const { return cells_; }
  const std::vector<Simplex>& cells_of(const Simplex& facet) const { return cells_of_.at(facet); }

  /// The partner if it has one of that many vertices, else nothing.
  Simplex partner(const Simplex& simplex, std::size_t size) const {
    const auto found = gradient_.partner.find(simplex);
    return found != gradient_.partner.end() && found->second.size() == size ? found->second : Simplex{};
  }

  std::vector<Simplex> down_from(Simplex vertex) const {
    std::vector<Simplex> path = {vertex};
    for (Simplex edge; !(edge = partner(vertex, 2)).empty(); path.push_back(vertex)) {
      vertex = {edge[0] == vertex[0] ? edge[1] : edge[0]};
    }
    return path;
  }

  /// Empty if it leaves through the surface.
  std::vector<Simplex> up_from(Simplex cell) const {
    std::vector<Simplex> path = {cell};
    for (Simplex facet; !(facet = partner(cell, cell.size() - 1)).empty(); path.push_back(cell)) {
      const auto& sides = cells_of(facet);
      const auto next = std::find_if(sides.begin(), sides.end(), [&](const Simplex& side) { return side != cell; });
      if (next == sides.end()) return {};
      cell = *next;
    }
    return path;
  }

  std::set<Simplex> descending_wall(const Simplex& critical_triangle) const {
    std::set<Simplex> wall;
    std::vector<Simplex> rest = {critical_triangle};
    while (!rest.empty()) {
      const Simplex triangle = rest.back();
      rest.pop_back();
      if (!wall.insert(triangle).second) continue;
      for (const Simplex& edge : facets_of(triangle)) {
        const Simplex next = partner(edge, 3);
        if (!next.empty()) rest.push_back(next);
      }
    }
    return wall;
  }

  std::set<Simplex> ascending_wall(const Simplex& critical_edge) const {
    std::set<Simplex> wall;
    std::vector<Simplex> rest = {critical_edge};
    while (!rest.empty()) {
      const Simplex edge = rest.back();
      rest.pop_back();
      if (!wall.insert(edge).second) continue;
      for (const Simplex& triangle : triangles_of_.at(edge)) {
        const Simplex next = partner(triangle, 2);
        if (!next.empty()) rest.push_back(next);
      }
    }
    return wall;
  }

  /// The triangles of a wall from which a path may fall to an edge.
  std::vector<Simplex> above(const Simplex& edge, const std::set<Simplex>& wall) const {
    std::vector<Simplex> above;
    for (const Simplex& triangle : triangles_of_.at(edge)) {
      if (wall.count(triangle) != 0 && partner(edge, 3) != triangle) above.push_back(triangle);
    }
    return above;
  }

 private:
  const BruteForceGradient& gradient_;
  std::vector<Simplex> cells_;
  std::map<Simplex, std::vector<Simplex>> cells_of_;
  std::map<Simplex, std::set<Simplex>> triangles_of_;
};

/// The connectors of one critical triangle.
class Connectors {
 public:
  Connectors(const Paths& paths, const Simplex& triangle, const std::set<Simplex>& wall)
      : paths_(paths), triangle_(triangle), wall_(wall) {}

  NamedComplex::Path from(const Simplex& critical_edge) {
    NamedComplex::Path path{critical_edge, triangle_, {}, count_paths(critical_edge) == 1};
    Simplex edge = critical_edge;
    do {
      path.cells.push_back(paths_.above(edge, wall_).front());  // the first in lexicographic order
      edge = paths_.partner(path.cells.back(), 2);
    } while (!edge.empty());
    return path;
  }

 private:
  /// How many lead from the triangle to an edge.
  double count_paths(const Simplex& edge) {
    const auto known = counts_.find(edge);
    if (known != counts_.end()) return known->second;
    double count = 0;
    for (const Simplex& triangle : paths_.above(edge, wall_)) {
      count += triangle == triangle_ ? 1 : count_paths(paths_.partner(triangle, 2));
    }
    return counts_[edge] = count;
  }

  const Paths& paths_;
  const Simplex triangle_;
  const std::set<Simplex>& wall_;
  std::map<Simplex, double> counts_;
};

void add_connectors(const Paths& paths, const Simplex& triangle, const std::set<Simplex>& wall,
                    const std::set<Simplex>& critical_edges, NamedComplex& all) {
  std::set<Simplex> met;
  for (const Simplex& each : wall) {
    for (const Simplex& edge : facets_of(each)) {
      if (critical_edges.count(edge) != 0) met.insert(edge);
    }
  }
  Connectors connectors(paths, triangle, wall);
  for (const Simplex& edge : met) all.connectors.push_back(connectors.from(edge));
}

/// The walls of all critical edges, and the tetrahedra around each edge of them.
void add_ascending_walls(const Paths& paths, const BruteForceGradient& gradient, NamedComplex& all) {
  std::map<Simplex, std::vector<Simplex>> around;
  for (const Simplex& tetrahedron : paths.cells()) {
    for (const Id a : tetrahedron) {
      for (const Id b : tetrahedron) {
        if (a < b) around[{a, b}].push_back(tetrahedron);
      }
    }
  }
  for (auto& edge_and_star : around) std::sort(edge_and_star.second.begin(), edge_and_star.second.end());
  for (const Simplex& edge : gradient.critical[1]) {
    const auto wall = paths.ascending_wall(edge);
    all.ascending_walls.push_back({edge, {wall.begin(), wall.end()}, {}});
    for (const Simplex& cell : wall) all.ascending_walls.back().polygons.push_back(around.at(cell));
  }
}

void add_manifolds(const CellsOf& mesh, const Paths& paths, NamedComplex& all) {
  all.ascending_manifold.resize(mesh.vertices);
  for (Id v = 0; v < mesh.vertices; ++v) {
    all.descending_manifold.push_back(paths.down_from({v}).back());
    for (const Simplex& cell : paths.cells()) {
      if (std::find(cell.begin(), cell.end(), v) == cell.end()) continue;
      const auto path = paths.up_from(cell);
      if (!path.empty()) all.ascending_manifold[v] = path.back();
      break;
    }
  }
}

}  // namespace

NamedComplex brute_force_complex(const CellsOf& mesh, const BruteForceGradient& gradient) {
  const Paths paths(mesh, gradient);
  NamedComplex all;
  const std::size_t top = mesh.dimension;
  for (std::size_t d = 0; d < top; ++d)
    all.critical[d].assign(gradient.critical[d].begin(), gradient.critical[d].end());
  for (const Simplex& cell : paths.cells()) {
    if (gradient.critical[top].count(cell) != 0) all.critical[top].push_back(cell);
  }
  for (const Simplex& edge : gradient.critical[1]) {
    for (const Id vertex : edge) {
      const auto path = paths.down_from({vertex});
      all.descending.push_back({edge, path.back(), path, true});
    }
  }
  for (const Simplex& facet : gradient.critical[top - 1]) {
    for (const Simplex& cell : paths.cells_of(facet)) {
      const auto path = paths.up_from(cell);
      if (!path.empty()) all.ascending.push_back({facet, path.back(), path, true});
    }
  }
  add_manifolds(mesh, paths, all);
  if (mesh.dimension == 2) return all;
  for (const Simplex& triangle : gradient.critical[2]) {
    const auto wall = paths.descending_wall(triangle);
    all.descending_walls.push_back({triangle, {wall.begin(), wall.end()}, {}});
    add_connectors(paths, triangle, wall, gradient.critical[1], all);
  }
  add_ascending_walls(paths, gradient, all);
  return all;
}

const std::vector<NamedComplex>& brute_force_complexes(const std::string& mesh_name) {
  static std::map<std::string, std::vector<NamedComplex>> known;
  std::vector<NamedComplex>& complexes = known[mesh_name];
  if (complexes.empty()) {
    for (const BruteForceGradient& gradient : brute_force_gradients(mesh_name)) {
      complexes.push_back(brute_force_complex(mesh_named(mesh_name), gradient));
    }
  }
  return complexes;
}

}  // namespace gale::test
