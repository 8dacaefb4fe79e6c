#pragma once

#include <gale/distributed/exchange_plan.hpp>
#include <gale/distributed/host_points.hpp>
#include <gale/distributed/local_vertices.hpp>

namespace gale::detail {

/// A point on its way to another rank.
struct SentPoint {
  double coordinates[3];
};

/// Where the vertices are that a rank holds: those that it owns, and its ghosts, each in their order.
struct OwnAndGhosts {
  HostPoints owned, ghosts;

  /// All of them, by local input ids.
  Points<double, HostMemory> by_id(const LocalVertices& vertices) const;
};

/// From the points that a rank hands over, and those that it has fetched by `plan` from others. Where `run` has what it
/// owns, only ghosts were fetched, and the others stay where they are.
OwnAndGhosts own_and_ghosts(const LocalVertices& vertices, const HostPoints& given, const ExchangePlan::Run& run,
                            const ExchangePlan& plan, const Dealt<SentPoint>& fetched);

}  // namespace gale::detail
