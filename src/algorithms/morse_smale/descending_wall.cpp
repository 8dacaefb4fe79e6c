#include <algorithm>
#include <memory>
#include <utility>

#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/morse_smale/gathered_separatrices.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

DescendingWall::DescendingWall(const DiscreteGradient& gradient, const TurnedEdges* turned)
    : pairs_(gradient.store().pairs()),
      vertex_successor_(gradient.vertex_successors().data()),
      keys_(gradient.order().keys()),
      vertex_input_(gradient.mesh().vertices_in_input()),
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
  return written(vertex_input_, a) < written(vertex_input_, b);
}

namespace {

/// One thread's part.
class SurfaceTracer {
 public:
  SurfaceTracer(const DiscreteGradient& gradient, const TurnedEdges* turned, Paths told)
      : wall(gradient, turned), keys_(gradient.order().keys()), told_(told) {}

  void add_wall(Id triangle) {
    walls.sources.push_back(triangle);
    walls.cells.insert(walls.cells.end(), wall.triangles().begin(), wall.triangles().end());
    walls.begin.push_back(static_cast<Offset>(walls.cells.size()));
  }

  void add_connectors(const CriticalPlaces& places, Id triangle) {
    rim_.clear();
    const std::uint64_t highest = keys_[wall.triangles().front()[0]];
    for (const auto& edge : wall.critical_edges()) {
      if (keys_[edge.high] <= highest) rim_.push_back({places.of_edge(edge.high, edge.low), edge});
    }
    std::sort(rim_.begin(), rim_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [place, edge] : rim_) {
      connectors.sources.push_back(place);
      connectors.destinations.push_back(triangle);
      const auto [is_only, joins] = wall.append_path(edge, connectors.cells, told_);
      connectors.is_only.push_back(is_only);
      if (told_ == Paths::joined) connectors.joins.push_back(joins);
      connectors.begin.push_back(static_cast<Offset>(connectors.cells.size()));
    }
  }

  DescendingWall wall;
  Separatrices<TriangleVertices> walls, connectors;

 private:
  const std::uint64_t* keys_;
  const Paths told_;
  std::vector<std::pair<Id, DescendingWall::Edge>> rim_;  ///< the wall's critical edges by their places
};

}  // namespace

DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned, Paths told) {
  const auto& triangles = critical.triangles;
  const auto tracers = traced(
      triangles, threads, [&](int) { return std::make_unique<SurfaceTracer>(gradient, turned, told); },
      [&](SurfaceTracer& tracer, Id place) {
        tracer.wall.follow(triangles[place]);
        if (want_walls) tracer.add_wall(place);
        if (want_connectors) tracer.add_connectors(places, place);
      });
  using Surfaces = Separatrices<TriangleVertices>;
  const Id count = static_cast<Id>(triangles.size());
  return {gathered(tracers, &SurfaceTracer::walls, &Surfaces::sources, count),
          gathered(tracers, &SurfaceTracer::connectors, &Surfaces::destinations, count)};
}

}  // namespace gale::detail
