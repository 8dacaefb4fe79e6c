#include <algorithm>
#include <memory>
#include <utility>

#include <gale/algorithms/morse_smale/descending_surfaces.hpp>
#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/morse_smale/gathered_separatrices.hpp>
#include <gale/algorithms/morse_smale/space_order.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

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
      append_path(edge);
      connectors.begin.push_back(static_cast<Offset>(connectors.cells.size()));
    }
  }

  DescendingWall wall;
  Separatrices<TriangleVertices> walls, connectors;

 private:
  void append_path(const DescendingWall::Edge& edge) {
    if (told_ == Paths::whole) {
      connectors.is_only.push_back(wall.append_path(edge, connectors.cells));
    } else {
      const auto [is_only, joins] = wall.append_joined_path(edge, connectors.cells);
      connectors.is_only.push_back(is_only);
      connectors.joins.push_back(joins);
    }
  }

  const std::uint64_t* keys_;
  const Paths told_;
  std::vector<std::pair<Id, DescendingWall::Edge>> rim_;  ///< the wall's critical edges by their places
};

}  // namespace

DescendingSurfaces descending_surfaces(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                       const CriticalPlaces& places, bool want_walls, bool want_connectors, int threads,
                                       const TurnedEdges* turned, Paths told) {
  const auto& triangles = critical.triangles;
  std::vector<std::unique_ptr<SurfaceTracer>> tracers(threads);
  const std::vector<Id> order = space_order(triangles);
  in_turns(threads, static_cast<std::int64_t>(triangles.size()), [&](int thread, std::int64_t i) {
    auto& tracer = tracers[thread];
    if (!tracer) tracer = std::make_unique<SurfaceTracer>(gradient, turned, told);
    tracer->wall.follow(triangles[order[i]]);
    if (want_walls) tracer->add_wall(order[i]);
    if (want_connectors) tracer->add_connectors(places, order[i]);
  });
  std::vector<Separatrices<TriangleVertices>> walls, connectors;
  for (auto& tracer : tracers) {
    if (!tracer) continue;
    walls.push_back(std::move(tracer->walls));
    connectors.push_back(std::move(tracer->connectors));
  }
  using Surfaces = Separatrices<TriangleVertices>;
  const Id count = static_cast<Id>(triangles.size());
  return {gathered(walls, &Surfaces::sources, count), gathered(connectors, &Surfaces::destinations, count)};
}

}  // namespace gale::detail
