#pragma once

#include <array>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/distributed/communicator.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// What simplices are put in order by: e.g. their global ids, ascending. The first is 0 or more.
using SimplexKey = std::array<GlobalId, 3>;

/// Places of keys among all.
struct KeyPlaces {
  Array<GlobalId, HostMemory> places;
  GlobalId count;
};

/// For each key of this rank its place among the different keys of all ranks, in lexicographic order; and how many
/// these are. Collective; each rank sorts those of an interval.
GALE_EXPORT KeyPlaces places_of_keys(const Communicator& ranks, const Array<const SimplexKey, HostMemory>& keys);

}  // namespace gale::detail
