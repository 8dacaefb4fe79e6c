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

/// Places among what all ranks have: those of what this rank has, and how many there are.
struct PlacesOfAll {
  Array<GlobalId, HostMemory> places;
  GlobalId count;
};

/// For each key of this rank its place among the different keys of all ranks, in lexicographic order. Each rank sorts
/// those of an interval.
GALE_EXPORT PlacesOfAll places_of_keys(const Ranks& ranks, const Array<const SimplexKey, HostMemory>& keys);

/// For each id of this rank the sum of the counts of all lower ids, of all ranks: the place of its first, where each id
/// counts things that follow one another by id. An id occurs once on all ranks.
GALE_EXPORT PlacesOfAll sums_before(const Ranks& ranks, const Array<const GlobalId, HostMemory>& ids,
                                    const Array<const GlobalId, HostMemory>& counts);

/// For each number of `asked` how often it occurs among `all` of all ranks; numbers are 0 or more.
GALE_EXPORT Array<GlobalId, HostMemory> occurrences(const Ranks& ranks, const Array<const GlobalId, HostMemory>& all,
                                                    const Array<const GlobalId, HostMemory>& asked);

}  // namespace gale::detail
