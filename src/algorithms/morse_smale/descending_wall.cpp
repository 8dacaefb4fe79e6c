#include <utility>

#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

WallGround ground_of(const DiscreteGradient& gradient) {
  const Mesh& mesh = gradient.mesh();
  const Id vertices = mesh.vertices();
  return {gradient.store().pairs(),
          {gradient.store().vertex_steps(), vertices},
          {gradient.order().keys(), vertices},
          {mesh.vertices_in_input(), vertices},
          mesh.owned_vertices()};
}

DescendingWall::DescendingWall(const WallGround& ground, const TurnedEdges* turned)
    : ground_(ground), turned_(turned) {}

void DescendingWall::follow(const TriangleVertices& critical) {
  floor_ = 0;
  begin(critical);
  cross(critical[0], critical[1], 0);
  follow_from(0);
}

void DescendingWall::follow_on(Part part) {
  floor_ = 0;
  begin(part.triangles.front());
  triangles_ = std::move(part.triangles);
  critical_edges_ = std::move(part.critical_edges);
  reach(triangles_[0][0], triangles_[0][1], 0);
  const std::size_t known = triangles_.size();
  for (std::uint32_t i = 0; i < known; ++i) {
    stop_if_asked_at(i);
    for_each_side(i, [&](Id high, Id low) { reach(high, low, i); });
  }
  for (const Edge& exit : part.exits) go_on(exit.high, exit.low);
  follow_from(known);
}

/// Crosses the sides of this triangle and of all that come after it.
void DescendingWall::follow_from(std::size_t triangle) {
  constexpr std::size_t ahead = 16;
  std::size_t near = triangle;
  for (std::size_t i = triangle; i < triangles_.size(); ++i) {
    stop_if_asked_at(static_cast<std::int64_t>(i));
    for (; near < triangles_.size() && near <= i + ahead; ++near) prefetch(triangles_[near]);
    cross_sides(static_cast<std::uint32_t>(i));
  }
}

/// Has what the crossing of a triangle's sides will read brought near.
void DescendingWall::prefetch(const TriangleVertices& triangle) const {
  for (const Id vertex : triangle) ground_.pairs.prefetch(vertex);
}

bool DescendingWall::follow_to(const TriangleVertices& critical, const Edge& edge, bool above_it) {
  floor_ = above_it ? ground_.keys[edge.high] : 0;
  begin(critical);
  cross(critical[0], critical[1], 0);
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
  exits_.clear();
  passed_.clear();
  above_.clear();
}

/// Calls visit(high, low) with the two edges of a triangle that it isn't paired with.
template <class Visit>
void DescendingWall::for_each_side(std::uint32_t triangle, const Visit& visit) const {
  const auto [a, b, c] = triangles_[triangle];
  const auto in_order = [&](Id one, Id other) {
    const bool is_higher = ground_.keys[one] > ground_.keys[other];
    visit(is_higher ? one : other, is_higher ? other : one);
  };
  if (turned_ == nullptr) {
    visit(a, c);
  } else {
    in_order(a, c);
  }
  in_order(b, c);
}

void DescendingWall::cross_sides(std::uint32_t triangle) {
  for_each_side(triangle, [&](Id high, Id low) { cross(high, low, triangle); });
}

void DescendingWall::cross(Id high, Id low, std::uint32_t from) {
  if (floor_ != 0 && ground_.keys[high] < floor_) return;
  if (!reach(high, low, from)) return;
  if (!ground_.owned.has(high)) return exits_.push_back({high, low});
  go_on(high, low);
}

/// Notes that a triangle has an edge: false where another one has it, too.
bool DescendingWall::reach(Id high, Id low, std::uint32_t from) {
  const auto [above, is_new] = above_.insert(pair_key(high, low));
  if (is_new) {
    above = {from, false};
    return true;
  }
  above.are_several = true;
  if (is_less(triangles_[from], triangles_[above.least])) above.least = from;
  return false;
}

/// Goes on across an edge.
void DescendingWall::go_on(Id high, Id low) {
  const Id third = third_of(high, low);
  if (third >= 0) {
    triangles_.push_back({high, low, third});
    ground_.pairs.prefetch_place(third);
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
  const PairedEdges row = ground_.pairs[high];
  const Id place = row.find(low);
  if (place == no_id) return TurnedEdges::with_vertex;  // of an edge of another rank, which tells no such edges
  const Id third = row.third(place);
  return third == no_id && ground_.vertex_successor[high] == low ? TurnedEdges::with_vertex : third;
}

DescendingWall::Appended DescendingWall::append_path(const Edge& from, std::vector<TriangleVertices>& path,
                                                     Paths told) {
  if (told == Paths::joined) passed_.resize(triangles_.size(), 0);
  Appended appended{true, false};
  for (Edge edge = from;;) {
    const Above& above = *above_.find(pair_key(edge.high, edge.low));
    appended.is_only = appended.is_only && !above.are_several;
    const TriangleVertices& triangle = triangles_[above.least];
    if (!appended.joins) path.push_back(triangle);
    if (told == Paths::joined && above.least != 0)
      appended.joins = appended.joins || std::exchange(passed_[above.least], 1) != 0;
    if (above.least == 0) return appended;
    edge = {triangle[0], triangle[1]};
  }
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
  return written(ground_.vertex_names, a) < written(ground_.vertex_names, b);
}

}  // namespace gale::detail
