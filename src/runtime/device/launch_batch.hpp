#pragma once

#include <algorithm>
#include <vector>

#include <gale/runtime/segment_bounds.hpp>

namespace gale::detail {

/// Segments in the order in which kernels are launched on them: first those that the fast scratch memory suffices for.
struct LaunchOrder {
  std::vector<Id> segments;
  Id large = 0;  ///< how many come last

  template <class IsLarge>
  static LaunchOrder of(std::vector<Id> segments, const IsLarge& is_large) {
    const auto is_usual = [&](Id segment) { return !is_large(segment); };
    const auto first_large = std::stable_partition(segments.begin(), segments.end(), is_usual);
    const auto large = static_cast<Id>(segments.end() - first_large);
    return {std::move(segments), large};
  }
};

/// Launches a kernel on the segments of a batch: on most of them in the fast scratch memory, and on the large ones in
/// as much as they need, so many at a time that all of it isn't too much; on all in at least what `least` says. `order`
/// has the `count` segments of `task`, or none where none of them is large. Returns whether the fast one sufficed.
/// Throws OutOfMemory if there is no scratch memory.
template <class Memory>
bool launch_batch(const typename SegmentKernel<Memory>::Space& instance, SegmentKernel<Memory>& kernel,
                  const SegmentBounds& bounds, const KernelTask& task, const LaunchOrder& order, Id count,
                  const StarSizes& least);

}  // namespace gale::detail
