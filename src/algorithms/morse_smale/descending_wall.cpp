#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/morse_smale/gathered_separatrices.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

WallGround::WallGround(const DiscreteGradient& gradient)
    : pairs(gradient.store().pairs()),
      vertex_successor(gradient.vertex_successors().data()),
      keys(gradient.order().keys()),
      vertex_input(gradient.mesh().vertices_in_input()),
      owned(gradient.mesh().owned_vertices()) {}

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
  std::size_t near = triangle;
  for (std::size_t i = triangle; i < triangles_.size(); ++i) {
    stop_if_asked_at(static_cast<std::int64_t>(i));
    for (; near < triangles_.size() && near < i + 17; ++near) prefetch(triangles_[near]);
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
  const EdgePairRow row = ground_.pairs[high];
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
  return written(ground_.vertex_input, a) < written(ground_.vertex_input, b);
}

/// One thread's part.
class SurfaceTracer {
 public:
  SurfaceTracer(const WallGround& ground, const TurnedEdges* turned, Paths told, std::size_t most_kept = 0)
      : wall(ground, turned), keys_(ground.keys), told_(told), left_to_keep_(most_kept) {}

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

  void add_exits(Id triangle) {
    unfinished.push_back({triangle, {}});
    if (wall.triangles().size() <= left_to_keep_) {
      left_to_keep_ -= wall.triangles().size();
      unfinished.back().second = wall.part();
    }
    for (const auto& edge : wall.exits()) {
      if (exit_keys_.insert(pair_key(edge.high, edge.low)).second) exits.push_back({edge.high, edge.low});
    }
  }

  DescendingWall wall;
  Separatrices<TriangleVertices> walls, connectors;
  /// Critical triangles whose walls others follow on, and these as far as they are here, or nothing of them.
  std::vector<std::pair<Id, DescendingWall::Part>> unfinished;
  std::vector<std::array<Id, 2>> exits;  ///< the edges from which others follow them on

 private:
  struct Mark {};

  const std::uint64_t* keys_;
  const Paths told_;
  std::size_t left_to_keep_;  ///< triangles of unfinished walls that there still is room for
  std::vector<std::pair<Id, DescendingWall::Edge>> rim_;  ///< the wall's critical edges by their places
  HashTable<Mark> exit_keys_;
};

namespace {

using Tracers = std::vector<std::unique_ptr<SurfaceTracer>>;

Separatrices<TriangleVertices> gathered_connectors(const Tracers& tracers, std::size_t triangles) {
  return gathered(tracers, &SurfaceTracer::connectors, &Separatrices<TriangleVertices>::destinations,
                  static_cast<Id>(triangles));
}

}  // namespace

DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned, Paths told) {
  const auto& triangles = critical.triangles;
  const WallGround ground(gradient);
  const auto tracers = traced(
      triangles, threads, [&](int) { return std::make_unique<SurfaceTracer>(ground, turned, told); },
      [&](SurfaceTracer& tracer, Id place) {
        tracer.wall.follow(triangles[place]);
        if (want_walls) tracer.add_wall(place);
        if (want_connectors) tracer.add_connectors(places, place);
      });
  using Surfaces = Separatrices<TriangleVertices>;
  const Id count = static_cast<Id>(triangles.size());
  return {gathered(tracers, &SurfaceTracer::walls, &Surfaces::sources, count),
          gathered_connectors(tracers, triangles.size())};
}

/// What the threads have found so far.
struct ConnectorsHere::Found {
  std::vector<std::unique_ptr<SurfaceTracer>> tracers;
};

ConnectorsHere::ConnectorsHere(const DiscreteGradient& gradient, const CriticalPlaces& places, int threads)
    : triangles_(gradient.critical().triangles), threads_(threads), found_(std::make_unique<Found>()) {
  const WallGround ground(gradient);
  const auto most_kept = static_cast<std::size_t>(gradient.mesh().vertices());
  found_->tracers = traced(
      triangles_, threads,
      [&](int) { return std::make_unique<SurfaceTracer>(ground, nullptr, Paths::whole, most_kept / threads); },
      [&](SurfaceTracer& tracer, Id place) {
        tracer.wall.follow(triangles_[place]);
        if (tracer.wall.exits().empty()) return tracer.add_connectors(places, place);
        tracer.add_exits(place);
      });
  for (const auto& tracer : found_->tracers) {
    if (tracer) exits_.insert(exits_.end(), tracer->exits.begin(), tracer->exits.end());
  }
}

ConnectorsHere::~ConnectorsHere() = default;

Separatrices<TriangleVertices> ConnectorsHere::finish(const WallGround& wider, const CriticalPlaces& places,
                                                      const std::vector<Id>& edge_places) {
  std::vector<std::pair<Id, DescendingWall::Part>> unfinished;
  for (const auto& tracer : found_->tracers) {
    if (!tracer) continue;
    std::move(tracer->unfinished.begin(), tracer->unfinished.end(), std::back_inserter(unfinished));
    for (Id& source : tracer->connectors.sources) source = edge_places[source];
  }
  std::vector<TriangleVertices> triangles;
  for (const auto& [place, part] : unfinished) triangles.push_back(triangles_[place]);
  auto tracers = traced(
      triangles, threads_, [&](int) { return std::make_unique<SurfaceTracer>(wider, nullptr, Paths::whole); },
      [&](SurfaceTracer& tracer, Id i) {
        auto& [place, part] = unfinished[i];
        part.triangles.empty() ? tracer.wall.follow(triangles[i]) : tracer.wall.follow_on(std::move(part));
        tracer.add_connectors(places, place);
      });
  for (auto& tracer : tracers) found_->tracers.push_back(std::move(tracer));
  return gathered_connectors(found_->tracers, triangles_.size());
}

}  // namespace gale::detail
