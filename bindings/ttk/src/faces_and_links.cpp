#include <algorithm>

#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

/// GALE's ids of a cell's vertices, in the caller's order.
std::array<Id, 4> Connectivity::corners_of(Id cell) const {
  std::array<Id, 4> corners;
  for (int corner = 0; corner < 4; ++corner) corners[corner] = internal_[0][cells_.vertex(cell, corner)];
  return corners;
}

const std::array<Id, 3>& Connectivity::triangle_edges(Id triangle) const {
  return reader().triangle_edges.of(triangle, [this](Id wanted) {
    const auto row = face_row<Relation::FE>(simplices_, triangles_.internal(wanted));
    std::array<Id, 3> edges = {edges_.number(row[0]), edges_.number(row[1]), edges_.number(row[2])};
    std::sort(edges.begin(), edges.end());
    return edges;
  });
}

const std::array<Id, 6>& Connectivity::cell_edges(Id cell) const {
  return reader().cell_edges.of(cell, [this](Id wanted) {
    const auto corners = corners_of(wanted);
    std::array<Id, 6> edges;
    for (int place = 0; place < 6; ++place) {
      const auto [a, b] = std::minmax(corners[edge_corners[place][0]], corners[edge_corners[place][1]]);
      edges[place] = edges_.number(simplices_.edge_of(a, b));
    }
    return edges;
  });
}

const std::array<Id, 4>& Connectivity::cell_triangles(Id cell) const {
  return reader().cell_triangles.of(cell, [this](Id wanted) {
    const auto corners = corners_of(wanted);
    std::array<Id, 4> triangles;
    for (int place = 0; place < 4; ++place) {
      std::array<Id, 3> vertices;
      for (int i = 0; i < 3; ++i) vertices[i] = corners[triangle_corners[place][i]];
      std::sort(vertices.begin(), vertices.end());
      triangles[place] = triangles_.number(simplices_.triangle_of(vertices[0], vertices[1], vertices[2]));
    }
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
