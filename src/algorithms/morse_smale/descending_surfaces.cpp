#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/excerpt/wider_ground.hpp>
#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/morse_smale/gathered_separatrices.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/error.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

/// One thread's part.
class SurfaceTracer {
 public:
  SurfaceTracer(const WallGround& ground, const TurnedEdges* turned, Paths told, std::size_t most_kept = 0)
      : wall(ground, turned), keys_(ground.keys), told_(told), left_to_keep_(most_kept) {}

  /// Makes room for so many triangles of connectors: to make more of it again and again copies them all. What isn't
  /// used takes no memory.
  void expect_connectors(std::size_t triangles) { reserve(connectors.cells, triangles); }

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

  const NamedKeys keys_;
  const Paths told_;
  std::size_t left_to_keep_;  ///< triangles of unfinished walls that there still is room for
  std::vector<std::pair<Id, DescendingWall::Edge>> rim_;  ///< the wall's critical edges by their places
  HashTable<Mark> exit_keys_;
};

namespace {

using Tracers = std::vector<std::unique_ptr<SurfaceTracer>>;

/// Triangles of connectors that few meshes exceed; of a very large mesh enough for what is copied to matter little.
std::size_t usual_connectors(const Mesh& mesh) {
  constexpr std::size_t enough = std::size_t(1) << 26;
  return std::min(3 * static_cast<std::size_t>(mesh.vertices()), enough);
}

Separatrices<TriangleVertices> gathered_connectors(const Tracers& tracers, std::size_t triangles) {
  return gathered(tracers, &SurfaceTracer::connectors, &Separatrices<TriangleVertices>::destinations,
                  static_cast<Id>(triangles));
}

}  // namespace

DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned, Paths told) {
  const auto& triangles = critical.triangles;
  const WallGround ground = ground_of(gradient);
  const auto tracers = traced(
      triangles, threads,
      [&](int) {
        auto tracer = std::make_unique<SurfaceTracer>(ground, turned, told);
        if (want_connectors) tracer->expect_connectors(usual_connectors(gradient.mesh()) / threads);
        return tracer;
      },
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

ConnectorsHere::ConnectorsHere(const DiscreteGradient& gradient, int threads)
    : triangles_(gradient.critical().triangles),
      threads_(threads),
      are_by_kernels_(gradient.store().is_from_kernels()),
      found_(std::make_unique<Found>()) {
  if (are_by_kernels_) {
    for (const auto& [a, b, c] : triangles_) exits_.insert(exits_.end(), {{a, b}, {a, c}, {b, c}});
  } else {
    follow_here(gradient);
  }
}

/// Follows walls as far as they are in the part.
void ConnectorsHere::follow_here(const DiscreteGradient& gradient) {
  const CriticalPlaces places(gradient.critical());
  const WallGround ground = ground_of(gradient);
  const auto most_kept = static_cast<std::size_t>(gradient.mesh().vertices());
  found_->tracers = traced(
      triangles_, threads_,
      [&](int) {
        auto tracer = std::make_unique<SurfaceTracer>(ground, nullptr, Paths::whole, most_kept / threads_);
        tracer->expect_connectors(usual_connectors(gradient.mesh()) / threads_);
        return tracer;
      },
      [&](SurfaceTracer& tracer, Id place) {
        tracer.wall.follow(triangles_[place]);
        if (tracer.wall.exits().empty()) return tracer.add_connectors(places, place);
        tracer.add_exits(place);
      });
  for (const auto& tracer : found_->tracers) {
    if (tracer) exits_.insert(exits_.end(), tracer->exits.begin(), tracer->exits.end());
  }
  sort_distinct("GALE::sort_exits", exits_);  // walls of several threads have some in common
}

ConnectorsHere::~ConnectorsHere() = default;

FoundConnectors ConnectorsHere::finish(const WiderGradient& wider, const CriticalPlaces& places,
                                       const std::vector<Id>& edge_places) {
  std::vector<std::pair<Id, DescendingWall::Part>> unfinished;
  if (are_by_kernels_) {
    try {
      const auto rows = std::make_shared<const WiderRows>(wider);
      FoundConnectors found = device_connectors(rows->rows(), wider.critical());
      found.rows = rows;
      return found;
    } catch (const OutOfMemory&) {
      for (std::size_t i = 0; i < triangles_.size(); ++i) unfinished.push_back({static_cast<Id>(i), {}});
    }
  }
  const WiderGround wider_ground(wider);
  const WallGround ground = wider_ground.ground();
  for (const auto& tracer : found_->tracers) {
    if (!tracer) continue;
    std::move(tracer->unfinished.begin(), tracer->unfinished.end(), std::back_inserter(unfinished));
    for (Id& source : tracer->connectors.sources) source = edge_places[source];
  }
  std::vector<TriangleVertices> triangles;
  for (const auto& [place, part] : unfinished) triangles.push_back(triangles_[place]);
  auto tracers = traced(
      triangles, threads_, [&](int) { return std::make_unique<SurfaceTracer>(ground, nullptr, Paths::whole); },
      [&](SurfaceTracer& tracer, Id i) {
        auto& [place, part] = unfinished[i];
        part.triangles.empty() ? tracer.wall.follow(triangles[i]) : tracer.wall.follow_on(std::move(part));
        tracer.add_connectors(places, place);
      });
  for (auto& tracer : tracers) found_->tracers.push_back(std::move(tracer));
  return {gathered_connectors(found_->tracers, triangles_.size()), {}, {}, {}};
}

}  // namespace gale::detail
