#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <gale/base/types.hpp>

#include "support/input_mesh.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

/// A mesh of either kind of cells.
struct AnyMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<Id>> cells;

  AnyMesh(const InputMesh& mesh) : points(mesh.points) { add(mesh.tetrahedra); }
  AnyMesh(const InputSurface& mesh) : points(mesh.points) { add(mesh.triangles); }

  Id vertices() const { return static_cast<Id>(points.size()); }
  int dimension() const { return static_cast<int>(cells.front().size()) - 1; }

 private:
  template <class Cells>
  void add(const Cells& all) {
    for (const auto& cell : all) cells.emplace_back(cell.begin(), cell.end());
  }
};

/// What a triangulation of TTK's has to answer, from the cells alone, by maps: edges and triangles are numbered as they
/// are met first in the cells, each of which has its edges in the order 01 02 03 12 13 23 of its corners, and its
/// triangles in the order 012 123 230 301. Where cells are triangles, the relations to these are those to cells; the
/// triangles have no cells, and cells instead of triangles their neighbours.
struct ExpectedTriangulation {
  using Table = std::vector<std::vector<Id>>;

  Table edges, triangles;  ///< vertices, ascending but for those of cells
  Table vertex_neighbours, vertex_edges, vertex_triangles, vertex_stars, vertex_links;
  Table edge_triangles, edge_stars, edge_links;
  Table triangle_edges, triangle_stars, triangle_links;
  Table cell_edges, cell_triangles, cell_neighbours;
  std::vector<bool> vertex_on_surface, edge_on_surface, triangle_on_surface;
  bool manifold = true;

  explicit ExpectedTriangulation(const AnyMesh& mesh) {
    const Id vertices = mesh.vertices(), cells = static_cast<Id>(mesh.cells.size());
    const bool solid = mesh.dimension() == 3;
    if (solid) {
      cell_edges = number(mesh, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}, edges);
      cell_triangles = number(mesh, {{0, 1, 2}, {1, 2, 3}, {2, 3, 0}, {3, 0, 1}}, triangles);
    } else {
      cell_edges = number(mesh, {{0, 1}, {0, 2}, {1, 2}}, edges);
    }
    vertex_stars.resize(vertices);
    edge_stars.resize(edges.size());
    triangle_stars.resize(triangles.size());
    for (Id c = 0; c < cells; ++c) {
      for (const Id v : mesh.cells[c]) vertex_stars[v].push_back(c);
      for (const Id e : cell_edges[c]) edge_stars[e].push_back(c);
      if (!solid) continue;
      for (const Id f : cell_triangles[c]) triangle_stars[f].push_back(c);
    }
    vertex_neighbours.resize(vertices);
    vertex_edges.resize(vertices);
    for (Id e = 0; e < static_cast<Id>(edges.size()); ++e) {
      for (const int end : {0, 1}) {
        vertex_edges[edges[e][end]].push_back(e);
        vertex_neighbours[edges[e][end]].push_back(edges[e][1 - end]);
      }
    }
    vertex_triangles.resize(vertices);
    edge_triangles.resize(edges.size());
    triangle_edges.resize(triangles.size());
    for (Id f = 0; f < static_cast<Id>(triangles.size()); ++f) {
      for (const Id v : triangles[f]) vertex_triangles[v].push_back(f);
      for (const Id e : cell_edges[triangle_stars[f][0]]) {
        if (includes(triangles[f], edges[e])) triangle_edges[f].push_back(e);
      }
      std::sort(triangle_edges[f].begin(), triangle_edges[f].end());
      for (const Id e : triangle_edges[f]) edge_triangles[e].push_back(f);
    }
    const Table& facets = solid ? triangles : edges;
    const Table& facet_stars = solid ? triangle_stars : edge_stars;
    find_links(mesh);
    find_neighbours(solid ? cell_triangles : cell_edges, facet_stars);
    find_surface(facets, facet_stars);
    if (solid) return;
    triangles = mesh.cells;
    vertex_triangles = vertex_stars;
    edge_triangles = edge_stars;
    triangle_edges = cell_edges;
    cell_triangles = cell_neighbours;
    triangle_on_surface.resize(cells);
  }

 private:
  static bool includes(const std::vector<Id>& all, const std::vector<Id>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  }

  static Table number(const AnyMesh& mesh, const std::vector<std::vector<int>>& corners, Table& found) {
    std::map<std::vector<Id>, Id> numbers;
    Table of_cells;
    for (const auto& cell : mesh.cells) {
      of_cells.emplace_back();
      for (const auto& part : corners) {
        std::vector<Id> simplex;
        for (const int corner : part) simplex.push_back(cell[corner]);
        std::sort(simplex.begin(), simplex.end());
        const auto at = numbers.emplace(simplex, static_cast<Id>(found.size()));
        if (at.second) found.push_back(simplex);
        of_cells.back().push_back(at.first->second);
      }
    }
    return of_cells;
  }

  /// The one of a cell's simplices, `parts`, that has none of some vertices.
  static Id opposite(const std::vector<Id>& parts, const Table& simplices, const std::vector<Id>& vertices) {
    for (const Id part : parts) {
      const auto& simplex = simplices[part];
      if (std::find_first_of(simplex.begin(), simplex.end(), vertices.begin(), vertices.end()) == simplex.end()) {
        return part;
      }
    }
    return no_id;
  }

  /// The vertices opposite to a facet.
  static Table vertex_links_of(const AnyMesh& mesh, const Table& facets, const Table& stars) {
    Table links(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (const Id c : stars[f]) {
        for (const Id v : mesh.cells[c]) {
          if (!includes(facets[f], {v})) links[f].push_back(v);
        }
      }
    }
    return links;
  }

  void find_links(const AnyMesh& mesh) {
    const bool solid = mesh.dimension() == 3;
    for (Id v = 0; v < mesh.vertices(); ++v) {
      vertex_links.emplace_back();
      for (const Id c : vertex_stars[v]) {
        vertex_links[v].push_back(solid ? opposite(cell_triangles[c], triangles, {v})
                                        : opposite(cell_edges[c], edges, {v}));
      }
    }
    triangle_links = vertex_links_of(mesh, triangles, triangle_stars);
    if (!solid) edge_links = vertex_links_of(mesh, edges, edge_stars);
    for (std::size_t e = 0; solid && e < edges.size(); ++e) {
      edge_links.emplace_back();
      for (const Id c : edge_stars[e]) edge_links[e].push_back(opposite(cell_edges[c], edges, edges[e]));
    }
  }

  void find_neighbours(const Table& cell_facets, const Table& facet_stars) {
    for (Id c = 0; c < static_cast<Id>(cell_facets.size()); ++c) {
      cell_neighbours.emplace_back();
      auto ascending = cell_facets[c];
      std::sort(ascending.begin(), ascending.end());
      for (const Id f : ascending) {
        const auto& star = facet_stars[f];
        if (star.size() == 2) cell_neighbours[c].push_back(star[0] == c ? star[1] : star[0]);
      }
    }
  }

  void find_surface(const Table& facets, const Table& facet_stars) {
    vertex_on_surface.resize(vertex_stars.size());
    edge_on_surface.resize(edges.size());
    triangle_on_surface.resize(triangles.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      manifold = manifold && facet_stars[f].size() <= 2;
      if (facet_stars[f].size() != 1) continue;
      (triangles.empty() ? edge_on_surface : triangle_on_surface)[f] = true;
      for (const Id v : facets[f]) vertex_on_surface[v] = true;
      if (triangles.empty()) continue;
      for (const Id e : triangle_edges[f]) edge_on_surface[e] = true;
    }
  }
};

}  // namespace gale::test
