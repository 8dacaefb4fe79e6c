#include <algorithm>

#include <gale/base/bits.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

/// GALE's ids of vertices, ascending.
template <std::size_t n>
std::array<Id, n> Connectivity::sorted_internal(std::array<Id, n> vertices) const {
  for (std::size_t i = 0; i < n; ++i) {
    const Id vertex = vertex_internal_[vertices[i]];
    std::size_t at = i;
    for (; at > 0 && vertices[at - 1] > vertex; --at) vertices[at] = vertices[at - 1];
    vertices[at] = vertex;
  }
  return vertices;
}

Connectivity::Internal Connectivity::internal_by_vertices(Relation relation, Id simplex) const {
  if (row_dimension(relation) == 1) {
    if (!edges_.is_there()) refuse(relation);
    const auto [a, b] = sorted_internal(edge(simplex));
    return {simplices_.edge_of(a, b), a};
  }
  const auto [a, b, c] = sorted_internal(triangle(simplex));
  return {simplices_.triangle_of(a, b, c), a};
}

std::array<Id, 3> Connectivity::edges_of_triangle(Id triangle) const {
  const auto [a, b, c] = sorted_internal(part_of_cell(triangles_, triangle_corners, triangle));
  std::array<Id, 3> edges;
  edges[0] = edges_.number[simplices_.edge_of(a, b)];
  edges[1] = edges_.number[simplices_.edge_of(a, c)];
  edges[2] = edges_.number[simplices_.edge_of(b, c)];
  std::sort(edges.begin(), edges.end());
  return edges;
}

const std::array<Id, 3>& Connectivity::triangle_edges(Id triangle) const {
  return reader().triangle_edges.of(triangle, [this](Id wanted) {
    if (dimension() == 3) return edges_of_triangle(wanted);
    const auto& edges = cell_edges(wanted);
    return std::array<Id, 3>{edges[0], edges[1], edges[2]};
  });
}

const std::array<Id, 6>& Connectivity::cell_edges(Id cell) const {
  return reader().cell_edges.of(cell, [this](Id wanted) {
    auto edges = SortedCorners(cells_, wanted, vertex_internal_).edges(simplices_);
    for (Id& edge : edges) edge = edge == no_id ? no_id : edges_.number[edge];
    if (dimension() == 2) edges[2] = edges[3];  // which stays at its place, too
    return edges;
  });
}

const std::array<Id, 4>& Connectivity::cell_triangles(Id cell) const {
  return reader().cell_triangles.of(cell, [this](Id wanted) {
    auto triangles = SortedCorners(cells_, wanted, vertex_internal_).triangles(simplices_);
    for (Id& triangle : triangles) triangle = triangles_.number[triangle];
    return triangles;
  });
}

Row Connectivity::cell_neighbours(Id cell) const {
  const auto& found = reader().cell_neighbours.of(cell, [this](Id wanted) {
    std::array<Id, 4> facets;
    dimension() == 2 ? std::copy_n(cell_edges(wanted).begin(), 3, facets.begin())
                     : std::copy_n(cell_triangles(wanted).begin(), 4, facets.begin());
    std::sort(facets.begin(), facets.begin() + cells_.corners());
    std::array<Id, 5> neighbours;
    Id& count = neighbours[4] = 0;
    for (int i = 0; i < cells_.corners(); ++i) {
      const Row star = dimension() == 2 ? row<Relation::ET>(facets[i]) : row<Relation::FT>(facets[i]);
      if (star.size() == 2) neighbours[count++] = star[star[0] == wanted];
    }
    return neighbours;
  });
  return {found.data(), found[4]};
}

/// The vertex, the edge or the triangle that a cell has at some of its corners, given as bits.
Id Connectivity::simplex_at(Id cell, unsigned corners) const {
  switch (count_bits(corners)) {
    case 1:
      return cells_.vertex(cell, lowest_bit(corners));
    case 2:
      return cell_edges(cell)[place_of_corners[corners]];
    default:
      return cell_triangles(cell)[place_of_corners[corners]];
  }
}

}  // namespace gale::ttk
