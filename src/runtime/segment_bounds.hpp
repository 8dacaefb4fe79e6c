#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gale/relations/kernels/segment_kernel.hpp>

namespace gale::detail {

/// What the segments of a mesh need of a team's scratch memory.
struct SegmentBounds {
  int warps = 1;                       ///< of a team
  StarSizes usual;                     ///< what suffices for every segment that isn't large
  std::vector<std::uint8_t> is_large;  ///< by segment: 1 if it doesn't fit with the others
};

/// For a kernel whose teams should have so many threads; found out once, in parallel, and kept with the mesh. No
/// segment is large where teams are threads of the host.
template <class Memory>
std::shared_ptr<const SegmentBounds> segment_bounds(const Mesh& mesh, const SegmentKernel<Memory>& kernel,
                                                    int threads_per_segment);

}  // namespace gale::detail
