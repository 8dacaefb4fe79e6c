#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>

// The paths of several ranks, as far as one of them follows them by itself.

namespace gale::detail {

class PathSimplices;

/// How paths end on one rank: those of entries, as condensed_paths.hpp has them.
struct EndsHere {
  Mirrored<Id> of_entries;
  Mirrored<std::uint64_t> words;  ///< of the simplices that have entries; none: all have
  Mirrored<Id> before;
};

/// What a rank finds of its paths by itself.
struct PathsHere {
  Array<Id, HostMemory> exits;    ///< ascending
  EndsHere ends;                  ///< numbers of the critical ones, or after all of these the exits'
  Mirrored<Id> starts;            ///< of vertices' paths, by entry; none: themselves
  Array<Id, HostMemory> reached;  ///< the places of exits that somebody wants to know more of, ascending
};

/// Follows paths of vertices, upwards from their first_cells(). Wanted are the exits that these come to if the vertices
/// are owned, those that paths from simplices come to which other ranks share, and those that `others` come to, or are.
/// Where the successors are, if there is room.
PathsHere follow_here(const PathSimplices& simplices, const std::vector<Id>& others);

/// The numbers of the ends of some simplices' paths; no_id for one that leaves through the surface.
std::vector<Id> ends_of(const EndsHere& ends, const PathSimplices& all, const std::vector<Id>& simplices);

}  // namespace gale::detail
