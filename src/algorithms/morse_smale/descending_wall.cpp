#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/order/written.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

DescendingWall::DescendingWall(const DiscreteGradient& gradient, const TurnedEdges* turned)
    : pairs_(gradient.store().pairs()),
      vertex_successor_(gradient.vertex_successors().data()),
      keys_(gradient.order().keys()),
      vertex_input_(gradient.mesh().vertex_input().data()),
      turned_(turned) {}

void DescendingWall::follow(const TriangleVertices& critical) {
  floor_ = 0;
  begin(critical);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    stop_if_asked_at(i);
    prefetch(i + 8);
    cross_sides(i);
  }
}

/// Has what the crossing of a triangle's sides will read brought near.
void DescendingWall::prefetch(std::size_t triangle) const {
  if (triangle >= triangles_.size()) return;
  for (const Id vertex : triangles_[triangle]) pairs_.prefetch(vertex);
}

bool DescendingWall::follow_to(const TriangleVertices& critical, const Edge& edge, bool above_it) {
  floor_ = above_it ? keys_[edge.high] : 0;
  begin(critical);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    stop_if_asked_at(i);
    cross_sides(i);
    while (!critical_edges_.empty()) {
      const Edge met = critical_edges_.back();
      if (met.high == edge.high && met.low == edge.low) return true;
      critical_edges_.pop_back();
    }
  }
  return false;
}

void DescendingWall::begin(const TriangleVertices& critical) {
  triangles_.assign(1, critical);
  critical_edges_.clear();
  cancelled_edges_.clear();
  passed_.clear();
  above_.clear();
  cross(critical[0], critical[1], 0);
}

/// Crosses the two edges of a triangle that it isn't paired with.
void DescendingWall::cross_sides(std::uint32_t triangle) {
  const auto [a, b, c] = triangles_[triangle];
  if (turned_ == nullptr) {
    cross(a, c, triangle);
  } else {
    cross_in_order(a, c, triangle);
  }
  cross_in_order(b, c, triangle);
}

void DescendingWall::cross_in_order(Id a, Id b, std::uint32_t from) {
  const bool in_order = keys_[a] > keys_[b];
  cross(in_order ? a : b, in_order ? b : a, from);
}

void DescendingWall::cross(Id high, Id low, std::uint32_t from) {
  if (floor_ != 0 && keys_[high] < floor_) return;
  const auto [above, is_new] = above_.insert(pair_key(high, low));
  if (!is_new) {
    above.are_several = true;
    if (is_less(triangles_[from], triangles_[above.least])) above.least = from;
    return;
  }
  above = {from, false};
  const Id third = third_of(high, low);
  if (third >= 0) {
    triangles_.push_back({high, low, third});
    pairs_.prefetch_place(third);
  } else if (third == no_id) {
    critical_edges_.push_back({high, low});
  } else if (turned_ != nullptr && turned_->find(high, low) != nullptr) {
    cancelled_edges_.push_back({high, low});
  }
}

/// The third vertex of the triangle that an edge is paired with; no_id for a critical edge.
Id DescendingWall::third_of(Id high, Id low) const {
  if (turned_ != nullptr) {
    const Id* const turned = turned_->find(high, low);
    if (turned != nullptr) return *turned;
  }
  const EdgePairRow row = pairs_[high];
  const Id third = row.third(row.find(low));
  return third == no_id && vertex_successor_[high] == low ? TurnedEdges::with_vertex : third;
}

/// Calls visit(i) for the triangles on the path, by their places. True if it is the only path.
template <class Visit>
bool DescendingWall::visit_path(const Edge& from, const Visit& visit) const {
  bool is_only = true;
  Edge edge = from;
  while (true) {
    const Above& above = *above_.find(pair_key(edge.high, edge.low));
    is_only = is_only && !above.are_several;
    visit(above.least);
    if (above.least == 0) return is_only;
    edge = {triangles_[above.least][0], triangles_[above.least][1]};
  }
}

bool DescendingWall::append_path(const Edge& from, std::vector<TriangleVertices>& path) const {
  return visit_path(from, [&](std::uint32_t i) { path.push_back(triangles_[i]); });
}

DescendingWall::Joined DescendingWall::append_joined_path(const Edge& from, std::vector<TriangleVertices>& path) {
  passed_.resize(triangles_.size(), 0);
  bool joins = false;
  const bool is_only = visit_path(from, [&](std::uint32_t i) {
    if (joins) return;
    path.push_back(triangles_[i]);
    joins = i != 0 && passed_[i] != 0;
    passed_[i] = 1;
  });
  return {is_only, joins};
}

void DescendingWall::count_paths() {
  has_one_path_.assign(triangles_.size(), 1);
  for (std::size_t i = 1; i < triangles_.size(); ++i)  // what is above an edge alone comes before what is below
    has_one_path_[i] = paths_from({triangles_[i][0], triangles_[i][1]}) == 1;
}

int DescendingWall::paths_from(const Edge& edge) const {
  const Above* const above = above_.find(pair_key(edge.high, edge.low));
  if (above == nullptr) return 0;
  return !above->are_several && has_one_path_[above->least] ? 1 : 2;
}

bool DescendingWall::is_less(const TriangleVertices& a, const TriangleVertices& b) const {
  return written(vertex_input_, a) < written(vertex_input_, b);
}

}  // namespace gale::detail
