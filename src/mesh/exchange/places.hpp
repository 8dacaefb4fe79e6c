#pragma once

#include <array>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/ranks.hpp>

// Numbers that need all ranks to be known. All functions are collective.

namespace gale::detail {

/// What simplices are put in order by: e.g. their global ids, ascending. The first is 0 or more.
using SimplexKey = std::array<GlobalId, 3>;

/// Places of keys among all.
struct KeyPlaces {
  Array<GlobalId, HostMemory> places;
  GlobalId count;
};

/// For each key of this rank its place among the different keys of all ranks, in lexicographic order; and how many
/// these are. Each rank sorts those of an
/// interval.
GALE_EXPORT KeyPlaces places_of_keys(const Ranks& ranks, const Array<const SimplexKey, HostMemory>& keys);

/// For each id of this rank the sum of the counts of all lower ids, of all ranks; the last entry is the sum of all. An
/// id occurs once on all ranks.
GALE_EXPORT Array<GlobalId, HostMemory> sums_before(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids,
                                                    const Array<const GlobalId, HostMemory>& counts);

/// For each number of `asked` how often it occurs among `all` of all ranks; numbers are 0 or more.
GALE_EXPORT Array<GlobalId, HostMemory> occurrences(const Ranks& ranks, const Array<const GlobalId, HostMemory>& all,
                                                    const Array<const GlobalId, HostMemory>& asked);

}  // namespace gale::detail
