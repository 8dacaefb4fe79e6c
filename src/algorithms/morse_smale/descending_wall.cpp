#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/order/written.hpp>

namespace gale::detail {

DescendingWall::DescendingWall(const DiscreteGradient& gradient)
    : pairs_(gradient.store().pairs),
      vertex_successor_(gradient.vertex_successors().data()),
      keys_(gradient.order().keys()),
      vertex_input_(gradient.mesh().vertex_input().data()) {}

void DescendingWall::follow(const TriangleVertices& critical) {
  triangles_.assign(1, critical);
  critical_edges_.clear();
  above_.clear();
  cross(critical[0], critical[1], 0);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const auto [a, b, c] = triangles_[i];
    cross(a, c, i);
    const bool in_order = keys_[b] > keys_[c];
    cross(in_order ? b : c, in_order ? c : b, i);
  }
}

void DescendingWall::cross(Id high, Id low, std::uint32_t from) {
  const auto [above, is_new] = above_.insert(pair_key(high, low));
  if (!is_new) {
    above.are_several = true;
    if (is_less(triangles_[from], triangles_[above.least])) above.least = from;
    return;
  }
  above = {from, false};
  const EdgePairRow row = pairs_[high];
  const Id third = row.third(row.find(low));
  if (third != no_id) {
    triangles_.push_back({high, low, third});
  } else if (vertex_successor_[high] != low) {
    critical_edges_.push_back({high, low});
  }
}

bool DescendingWall::append_path(const Edge& from, std::vector<TriangleVertices>& path) const {
  bool is_only = true;
  Edge edge = from;
  while (true) {
    const Above& above = *above_.find(pair_key(edge.high, edge.low));
    const TriangleVertices& triangle = triangles_[above.least];
    is_only = is_only && !above.are_several;
    path.push_back(triangle);
    if (above.least == 0) return is_only;
    edge = {triangle[0], triangle[1]};
  }
}

bool DescendingWall::is_less(const TriangleVertices& a, const TriangleVertices& b) const {
  return written(vertex_input_, a) < written(vertex_input_, b);
}

}  // namespace gale::detail
