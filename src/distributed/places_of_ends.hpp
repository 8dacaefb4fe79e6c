#pragma once

#include <gale/distributed/distributed_paths.hpp>

namespace gale::detail {

/// For each end that paths have on this rank the place of the critical simplex where they end finally among those of
/// all ranks, by global id; -1 if they leave through the surface. Collective.
Array<const GlobalId, HostMemory> places_of_ends(const Communicator& ranks, const DistributedPaths& paths);

}  // namespace gale::detail
