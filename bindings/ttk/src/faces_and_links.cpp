#include <algorithm>

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
  return reader().triangle_edges.of(triangle, [this](Id wanted) { return edges_of_triangle(wanted); });
}

const std::array<Id, 6>& Connectivity::cell_edges(Id cell) const {
  return reader().cell_edges.of(cell, [this](Id wanted) {
    auto edges = SortedCorners(cells_, wanted, vertex_internal_).edges(simplices_);
    for (Id& edge : edges) edge = edges_.number[edge];
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
    auto triangles = cell_triangles(wanted);
    std::sort(triangles.begin(), triangles.end());
    std::array<Id, 5> neighbours;
    Id& count = neighbours[4] = 0;
    for (const Id triangle : triangles) {
      const Row star = row<Relation::FT>(triangle);
      if (star.size() == 2) neighbours[count++] = star[star[0] == wanted];
    }
    return neighbours;
  });
  return {found.data(), found[4]};
}

Id Connectivity::vertex_link(Id vertex, Id i) const {
  const Id cell = row<Relation::VT>(vertex)[i];
  const unsigned others = 15 ^ cells_.corners_of(cell, std::array<Id, 1>{vertex});
  return cell_triangles(cell)[place_of_corners[others]];
}

Id Connectivity::edge_link(Id edge, Id i) const {
  const Id cell = row<Relation::ET>(edge)[i];
  return cell_edges(cell)[place_of_corners[15 ^ cells_.corners_of(cell, this->edge(edge))]];
}

Id Connectivity::triangle_link(Id triangle, Id i) const {
  const Id cell = row<Relation::FT>(triangle)[i];
  const unsigned others = 15 ^ cells_.corners_of(cell, this->triangle(triangle));
  int corner = 0;
  while ((others >> corner & 1) == 0) ++corner;
  return cells_.vertex(cell, corner);
}

}  // namespace gale::ttk
