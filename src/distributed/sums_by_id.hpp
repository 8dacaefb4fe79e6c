#pragma once

#include <gale/distributed/home_table.hpp>
#include <gale/export.hpp>

namespace gale::detail {

/// For each id of this rank the sum of the counts of all lower ids, of all ranks; the last entry is the sum of all. An
/// id occurs once on all ranks. Collective.
GALE_EXPORT Array<GlobalId, HostMemory> sums_before(const Communicator& ranks,
                                                    const Array<const GlobalId, HostMemory>& ids,
                                                    const Array<const GlobalId, HostMemory>& counts);

/// For each number of `asked` how often it occurs among `all` of all ranks; numbers are 0 or more. Collective.
GALE_EXPORT Array<GlobalId, HostMemory> occurrences(const Communicator& ranks,
                                                    const Array<const GlobalId, HostMemory>& all,
                                                    const Array<const GlobalId, HostMemory>& asked);

}  // namespace gale::detail
