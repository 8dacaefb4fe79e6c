#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include <gale/algorithms/morse_smale/manifolds.hpp>
#include <gale/algorithms/persistence/joined_paths.hpp>
#include <gale/algorithms/persistence/morse_graph.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>

namespace gale {

namespace {

using detail::MorseGraph;
using HostSpace = Kokkos::DefaultHostExecutionSpace;

void require_parts(const MorseSmaleParts& parts) {
  std::string missing;
  const auto require = [&missing](bool is_there, const char* part) {
    if (!is_there) missing += (missing.empty() ? "" : ", ") + std::string(part);
  };
  require(parts.descending_separatrices, "descending separatrices");
  require(parts.ascending_separatrices, "ascending separatrices");
  require(parts.saddle_connectors, "saddle connectors");
  if (!missing.empty()) throw Error("simplify needs parts that the complex was computed without: " + missing);
}

/// The value of each node's highest vertex.
std::vector<double> values_of(const MorseSmaleComplex& complex, const std::function<double(Id)>& value) {
  const Mesh& mesh = complex.gradient.mesh();
  const Id* const input = mesh.vertex_input().data();
  const std::uint64_t* const keys = complex.gradient.order().keys();
  const auto higher = [&](Id a, Id b) { return keys[a] < keys[b]; };
  const CriticalSimplices& critical = complex.critical;
  std::vector<double> values;
  const auto add = [&](Id vertex) {
    values.push_back(value(input[vertex]));
    if (std::isnan(values.back()))
      throw Error("vertex " + std::to_string(input[vertex]) + " has no field value: it is NaN");
  };
  for (const Id vertex : critical.vertices) add(vertex);
  for (const auto& edge : critical.edges) add(edge[0]);
  for (const auto& triangle : critical.triangles) add(triangle[0]);
  const auto& tetrahedra = mesh.encoded().tetrahedra;
  for (const Id t : critical.tetrahedra) add(*std::max_element(&tetrahedra(t, 0), &tetrahedra(t, 0) + 4, higher));
  return values;
}

/// By node: the place of each simplex that is left among those of its dimension; no_id for the others.
std::vector<Id> places_left(const MorseGraph& graph) {
  std::vector<Id> places(graph.nodes(), no_id);
  Id next[4] = {};
  for (int node = 0; node < graph.nodes(); ++node) {
    if (graph.is_alive(node)) places[node] = next[graph.dimension(node)]++;
  }
  return places;
}

template <class Simplex>
std::vector<Simplex> left_of(const MorseGraph& graph, int dimension, const std::vector<Simplex>& simplices) {
  std::vector<Simplex> left;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if (graph.is_alive(graph.node(dimension, static_cast<Id>(i)))) left.push_back(simplices[i]);
  }
  return left;
}

CriticalSimplices critical_left(const MorseGraph& graph, const CriticalSimplices& all) {
  CriticalSimplices left;
  left.vertices = left_of(graph, 0, all.vertices);
  left.edges = left_of(graph, 1, all.edges);
  left.triangles = left_of(graph, 2, all.triangles);
  left.tetrahedra = left_of(graph, 3, all.tetrahedra);
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    if (!graph.is_alive(graph.node(2, static_cast<Id>(i)))) continue;
    left.star.insert(left.star.end(), all.star.begin() + all.star_begin[i], all.star.begin() + all.star_begin[i + 1]);
    left.star_begin.push_back(static_cast<Id>(left.star.size()));
  }
  return left;
}

/// The paths that are left from simplices of one dimension to those of another, in the order of a complex: connectors
/// by destination, then source; the others by source.
template <class Cell>
Separatrices<Cell> separatrices_left(const MorseGraph& graph, const std::vector<Id>& places, int from_dimension,
                                     int to_dimension, const Separatrices<Cell>& separatrices) {
  const bool rises = from_dimension < to_dimension;
  std::vector<std::tuple<Id, Id, int>> order;  // first place, second place, arc
  for (int i = 0; i < static_cast<int>(graph.arcs().size()); ++i) {
    const MorseGraph::Arc& arc = graph.arcs()[i];
    const int from = rises ? arc.low : arc.high, to = rises ? arc.high : arc.low;
    if (!arc.is_alive || graph.dimension(from) != from_dimension || graph.dimension(to) != to_dimension) continue;
    const bool is_connector = from_dimension == 1 && to_dimension == 2;
    order.push_back({places[is_connector ? to : from], is_connector ? places[from] : 0, i});
  }
  std::sort(order.begin(), order.end());
  detail::JoinedPaths<Cell> paths(graph, std::min(from_dimension, to_dimension), separatrices);
  Separatrices<Cell> left;
  for (const auto& [first, second, i] : order) {
    const MorseGraph::Arc& arc = graph.arcs()[i];
    left.sources.push_back(places[rises ? arc.low : arc.high]);
    left.destinations.push_back(places[rises ? arc.high : arc.low]);
    if (!separatrices.is_only.empty()) left.is_only.push_back(arc.is_only);
    paths.append(i, left.cells);
    left.begin.push_back(static_cast<Offset>(left.cells.size()));
  }
  return left;
}

/// The walls that make up the wall of a saddle that is left: its own, then the others, in the order of their places.
std::vector<Id> walls_of(const MorseGraph& graph, int saddle) {
  std::set<int> found = {saddle};
  std::vector<int> rest = {saddle};
  while (!rest.empty()) {
    const int node = rest.back();
    rest.pop_back();
    for (const int other : graph.joined(node)) {
      if (found.insert(other).second) rest.push_back(other);
    }
  }
  found.erase(saddle);
  std::vector<Id> walls = {graph.place(saddle)};
  for (const int node : found) walls.push_back(graph.place(node));
  return walls;
}

/// Calls add(place of a saddle, its walls) for each saddle of a dimension that is left.
template <class Add>
void for_each_wall_left(const MorseGraph& graph, int dimension, Id count, const Add& add) {
  for (Id i = 0; i < count; ++i) {
    const int node = graph.node(dimension, i);
    if (graph.is_alive(node)) add(node, walls_of(graph, node));
  }
}

template <class Cell>
Cell sorted(Cell cell) {
  std::sort(cell.begin(), cell.end());
  return cell;
}

Separatrices<TriangleVertices> descending_walls_left(const MorseGraph& graph, const std::vector<Id>& places,
                                                     const MorseSmaleComplex& complex) {
  Separatrices<TriangleVertices> left;
  const auto& walls = complex.descending_walls;
  if (walls.sources.empty()) return left;
  for_each_wall_left(graph, 2, walls.count(), [&](int saddle, const std::vector<Id>& parts) {
    std::set<TriangleVertices> seen;
    for (const Id part : parts) {
      for (const auto* cell = walls.first(part); cell != walls.last(part); ++cell) {
        if (parts.size() == 1 || seen.insert(sorted(*cell)).second) left.cells.push_back(*cell);
      }
    }
    left.sources.push_back(places[saddle]);
    left.begin.push_back(static_cast<Offset>(left.cells.size()));
  });
  return left;
}

AscendingWalls ascending_walls_left(const MorseGraph& graph, const std::vector<Id>& places,
                                    const MorseSmaleComplex& complex) {
  AscendingWalls left;
  const AscendingWalls& all = complex.ascending_walls;
  if (all.walls.sources.empty()) return left;
  for_each_wall_left(graph, 1, all.walls.count(), [&](int saddle, const std::vector<Id>& parts) {
    std::set<std::array<Id, 2>> seen;
    for (const Id part : parts) {
      for (Offset cell = all.walls.begin[part]; cell < all.walls.begin[part + 1]; ++cell) {
        if (parts.size() > 1 && !seen.insert(all.walls.cells[cell]).second) continue;
        left.walls.cells.push_back(all.walls.cells[cell]);
        left.star.insert(left.star.end(), all.star.begin() + all.star_begin[cell],
                         all.star.begin() + all.star_begin[cell + 1]);
        left.star_begin.push_back(static_cast<Offset>(left.star.size()));
      }
    }
    left.walls.sources.push_back(places[saddle]);
    left.walls.begin.push_back(static_cast<Offset>(left.walls.cells.size()));
  });
  return left;
}

Array<Id, HostMemory> manifold_left(MorseGraph& graph, const std::vector<Id>& places, int dimension, Id count,
                                    const Array<Id, HostMemory>& manifold) {
  if (manifold.extent(0) == 0) return manifold;
  std::vector<Id> heirs(count);
  for (Id i = 0; i < count; ++i) {
    const int heir = graph.heir(graph.node(dimension, i));
    heirs[i] = heir == MorseGraph::nowhere ? no_id : places[heir];
  }
  const auto left = allocate<Array<Id, HostMemory>>("GALE::manifold_left", manifold.extent(0));
  parallel_for("GALE::manifold_left", HostSpace(), manifold.extent(0),
               [&](Offset v) { left(v) = manifold(v) == no_id ? no_id : heirs[manifold(v)]; });
  return left;
}

}  // namespace

MorseSmaleComplex simplify(const MorseSmaleComplex& complex, const std::function<double(Id)>& value, double threshold) {
  require_parts(complex.parts);
  MorseGraph graph(complex, values_of(complex, value), threshold);
  graph.cancel();
  const std::vector<Id> places = places_left(graph);
  const auto counts = complex.critical.counts();
  MorseSmaleComplex left{complex.gradient, complex.parts, critical_left(graph, complex.critical)};
  left.descending = separatrices_left(graph, places, 1, 0, complex.descending);
  left.ascending = separatrices_left(graph, places, 2, 3, complex.ascending);
  left.connectors = separatrices_left(graph, places, 1, 2, complex.connectors);
  left.descending_walls = descending_walls_left(graph, places, complex);
  left.ascending_walls = ascending_walls_left(graph, places, complex);
  left.descending_manifold = manifold_left(graph, places, 0, counts[0], complex.descending_manifold);
  left.ascending_manifold = manifold_left(graph, places, 3, counts[3], complex.ascending_manifold);
  if (complex.morse_smale_manifold.extent(0) != 0) {
    std::tie(left.morse_smale_manifold, left.morse_smale_manifolds) =
        detail::morse_smale_manifolds(left.ascending_manifold, left.descending_manifold);
  }
  return left;
}

}  // namespace gale
