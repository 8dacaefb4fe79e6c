#pragma once

#include <array>
#include <functional>
#include <vector>

#include <gale/distributed/distributed_paths.hpp>
#include <gale/mesh/positions.hpp>

namespace gale::detail {

/// A simplex of another dimension between two on a path: its vertices' global ids, ascending, and where it is.
struct PathStep {
  std::array<GlobalId, 3> vertices{-1, -1, -1};
  Point point{};
};

/// A simplex on a path, and where it is.
struct PathCell {
  GlobalId id;
  Point point;
  PathStep next;  ///< between it and the one after it; nothing after the last
};

/// What paths tell of the simplices on the way, by GALE's ids.
struct PathShape {
  std::function<Point(Id)> point_of;
  std::function<PathStep(Id, Id)> step;  ///< between one and its successor
};

/// Paths with all their simplices: the i-th is cells[begin[i]] to cells[begin[i + 1] - 1]; empty if it leaves through
/// the surface.
struct WholePaths {
  std::vector<Offset> begin{0};
  std::vector<PathCell> cells;
};

/// The paths from some simplices of this rank (GALE's ids), from rank to rank.
///
/// The ranks that a path visits are found by halves: each knows where the path is 2^k changes of ranks later. Then all
/// of them send their pieces at once. So it takes as many rounds of messages as `paths` took, and two more. Collective.
WholePaths whole_paths(const Communicator& ranks, const DistributedPaths& paths, const std::vector<Id>& starts,
                       const PathShape& shape);

}  // namespace gale::detail
