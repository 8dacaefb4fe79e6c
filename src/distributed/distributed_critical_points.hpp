#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/distributed/distributed_order.hpp>

namespace gale {

/// The critical points of a mesh on several ranks: those that this rank owns, and how many there are in all.
struct DistributedCriticalPoints {
  std::vector<GlobalId> vertices;        ///< global ids, ascending
  std::vector<CriticalType> types;       ///< the type of each
  std::vector<std::uint8_t> on_surface;  ///< as CriticalPoints has it

  /// How many there are of each type but `regular`, on all ranks.
  std::array<GlobalId, 5> counts{};
};

/// Finds the critical points of a field on a mesh on several ranks: the same as of the whole mesh on one. `structure`
/// is one of the order's local mesh, preconditioned for critical_points_relations. Collective: one exchange of a byte a
/// ghost beside the sweep. Throws gale::Error on all ranks.
GALE_EXPORT DistributedCriticalPoints find_critical_points(Structure& structure, const DistributedOrder& order,
                                                           const SweepOptions& options = {});

/// Finds the same critical points by kernels where the relations are made.
GALE_EXPORT DistributedCriticalPoints find_critical_points(const WorkerSpace& space, const DistributedOrder& order,
                                                           const DeviceSweepOptions& options = {});

}  // namespace gale
