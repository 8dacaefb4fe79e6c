#include <gale/algorithms/detail/descending_wall.hpp>

#include <algorithm>

namespace gale::detail {

DescendingWall::DescendingWall(const DiscreteGradient& gradient)
    : gradient_(gradient), keys_(gradient.order().keys()), vertex_input_(gradient.mesh().vertex_input().data()) {}

void DescendingWall::follow(const TriangleVertices& critical) {
  triangles_.assign(1, critical);
  critical_edges_.clear();
  above_.clear();
  cross(critical[0], critical[1], critical);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const TriangleVertices triangle = triangles_[i];
    cross(triangle[0], triangle[2], triangle);
    const bool in_order = keys_[triangle[1]] > keys_[triangle[2]];
    cross(triangle[in_order ? 1 : 2], triangle[in_order ? 2 : 1], triangle);
  }
}

void DescendingWall::cross(Id high, Id low, const TriangleVertices& from) {
  const auto [above, is_new] = above_.insert(high, low);
  if (!is_new) {
    above.are_several = true;
    if (is_less(from, above.least)) above.least = from;
    return;
  }
  above = {from, false};
  const Id third = gradient_.triangle_of_lower_edge(high, low);
  if (third != no_id) {
    triangles_.push_back({high, low, third});
  } else if (gradient_.is_critical_edge(high, low, third)) {
    critical_edges_.push_back({high, low});
  }
}

bool DescendingWall::append_path(const Edge& from, std::vector<TriangleVertices>& path) const {
  bool is_only = true;
  Edge edge = from;
  while (true) {
    const Above& above = above_(edge.high, edge.low);
    is_only = is_only && !above.are_several;
    path.push_back(above.least);
    if (above.least == triangles_.front()) return is_only;
    edge = {above.least[0], above.least[1]};
  }
}

bool DescendingWall::is_less(const TriangleVertices& a, const TriangleVertices& b) const {
  const auto written = [&](const TriangleVertices& triangle) {
    TriangleVertices vertices = {vertex_input_[triangle[0]], vertex_input_[triangle[1]], vertex_input_[triangle[2]]};
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  return written(a) < written(b);
}

}  // namespace gale::detail
