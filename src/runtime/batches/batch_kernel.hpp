#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <gale/relations/kernels/segment_kernel.hpp>

namespace gale::detail {

/// Segments in the order in which kernels are launched on them: first those that the fast scratch memory suffices for.
struct LaunchOrder {
  std::vector<Id> segments;
  Id large = 0;  ///< how many come last
};

/// What the segments of a mesh need of a team's scratch memory.
struct SegmentBounds {
  int warps = 1;                       ///< a team's
  StarSizes usual;                     ///< what suffices for every segment that isn't large
  std::vector<std::uint8_t> is_large;  ///< by segment: 1 if it doesn't fit with the others
};

/// A segment kernel that is launched on batches, and what its teams need.
template <class Memory>
class BatchKernel {
 public:
  using Space = typename SegmentKernel<Memory>::Space;

  /// `wanted` is one of the sets of `kernels_for`. What teams of so many threads need is found out once for a mesh, in
  /// parallel, and kept with it. Of the fast scratch memory a team has at most so many bytes.
  BatchKernel(const Mesh& mesh, RelationSet wanted, int threads_per_segment,
              std::size_t most_fast = std::numeric_limits<std::size_t>::max());

  RelationSet wanted() const { return kernel_.wanted(); }

  /// Does a segment need more than the fast scratch memory? None does where teams are threads of the host, unless
  /// the constructor was told that they have little.
  bool is_large(Id segment) const { return bounds_->is_large[segment] != 0; }

  /// Launches it on the `count` segments of `task`: on most of them in the fast scratch memory, and on the large ones
  /// in as much as they need, so many at a time that all of it isn't too much; on all in at least what `least` says.
  /// `order` has these segments, or none where none of them is large. Returns whether the fast memory sufficed. Throws
  /// OutOfMemory if there is no scratch memory.
  bool launch(const Space& instance, const KernelTask& task, const LaunchOrder& order, Id count,
              const StarSizes& least);

 private:
  SegmentKernel<Memory> kernel_;
  std::size_t fast_;
  std::shared_ptr<const SegmentBounds> bounds_;
};

}  // namespace gale::detail
