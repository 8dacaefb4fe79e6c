#pragma once

#include <array>
#include <functional>
#include <vector>

#include <gale/distributed/distributed_paths.hpp>

namespace gale::detail {

/// A simplex on a path, and where it is.
struct PathCell {
  GlobalId id;
  std::array<double, 3> point;
};

/// Paths with all their simplices: the i-th is cells[begin[i]] to cells[begin[i + 1] - 1]; empty if it leaves through
/// the surface.
struct WholePaths {
  std::vector<Offset> begin{0};
  std::vector<PathCell> cells;
};

/// The paths from some simplices of this rank (GALE's ids), from rank to rank. `point_of` says where a local simplex
/// is.
///
/// The ranks that a path visits are found by halves: each knows where the path is 2^k changes of ranks later. Then all
/// of them send their pieces at once. So it takes as many rounds of messages as `paths` took, and two more. Collective.
WholePaths whole_paths(const Communicator& ranks, const DistributedPaths& paths, const std::vector<Id>& starts,
                       const std::function<std::array<double, 3>(Id)>& point_of);

}  // namespace gale::detail
