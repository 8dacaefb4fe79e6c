#pragma once

#include <gale/distributed/communicator.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/mesh/exchange/global_index.hpp>

namespace gale::detail {

/// For each point that this rank hands over, the rank that is to own it: the ranks share the space-filling curve
/// through all points, so that each owns about as many, which lie close to each other. By samples, the same ones in
/// each run; points at one place are told apart by their ids. Collective; throws gale::Error if a coordinate isn't
/// finite.
Array<int, HostMemory> curve_partition(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                       const HostPoints& points);

}  // namespace gale::detail
