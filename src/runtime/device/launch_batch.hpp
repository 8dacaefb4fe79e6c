#pragma once

#include <algorithm>
#include <vector>

#include <gale/runtime/segment_bounds.hpp>

namespace gale::detail {

/// What `launch_batch` is run on, beside the task, whose scratch memory it chooses itself.
struct BatchLaunch {
  Id count = 0;               ///< segments
  const Id* large = nullptr;  ///< those, on the host, that may need more than the fast scratch memory: the batch's last
  Id large_count = 0;         ///< so many
  StarSizes least;            ///< the scratch memory that each gets at least
};

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

  /// Of a batch of `count` segments, which are these or, where there are none of these, none of them large.
  BatchLaunch launch(Id count, const StarSizes& least) const {
    return {count, segments.data() + segments.size() - large, large, least};
  }
};

/// Launches a kernel on the segments of a batch: on most of them in the fast scratch memory, and on the large ones in
/// as much as they need, so many at a time that all of it isn't too much. Returns whether the fast one sufficed. Throws
/// OutOfMemory if there is no scratch memory.
template <class Memory>
bool launch_batch(const typename SegmentKernel<Memory>::Space& instance, SegmentKernel<Memory>& kernel,
                  const SegmentBounds& bounds, const KernelTask& task, const BatchLaunch& batch);

}  // namespace gale::detail
