#include <algorithm>
#include <limits>

#include <gale/base/parallel.hpp>
#include <gale/runtime/segment_bounds.hpp>

namespace gale::detail {

namespace {

/// More than this share of the segments should fit the fast scratch memory.
constexpr double share_that_fits = 0.99;

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

template <class Memory>
std::vector<StarSizes> bounds_of(const Mesh& mesh, const SegmentKernel<Memory>& kernel) {
  std::vector<StarSizes> bounds(mesh.segments());
  parallel_for("GALE::segment_bounds", Kokkos::DefaultHostExecutionSpace(), mesh.segments(),
               [&](Offset s) { bounds[s] = kernel.bound(static_cast<Id>(s)); });
  return bounds;
}

/// Gathers, segment after segment, what those need that fit the fast scratch memory together with the ones before. How
/// many don't.
template <class Memory>
Id gather(const std::vector<StarSizes>& bounds, const SegmentKernel<Memory>& kernel, SegmentBounds& found) {
  const std::size_t fast = is_device_memory<Memory> ? fast_scratch_bytes<WorkerSpace>() : no_limit;
  Id large = 0;
  found.usual = StarSizes();
  found.is_large.assign(bounds.size(), 0);
  for (std::size_t s = 0; s < bounds.size(); ++s) {
    if (found.usual.contains(bounds[s])) continue;
    const StarSizes together = larger(found.usual, bounds[s]);
    if (kernel.scratch_bytes(together, found.warps) <= fast) {
      found.usual = together;
    } else {
      found.is_large[s] = 1;
      ++large;
    }
  }
  return large;
}

}  // namespace

template <class Memory>
std::shared_ptr<const SegmentBounds> find_segment_bounds(const Mesh& mesh, const SegmentKernel<Memory>& kernel,
                                                         int threads_per_segment) {
  const int lanes = is_device_memory<Memory> ? 32 : threads_per_segment;
  const auto bounds = bounds_of(mesh, kernel);
  auto found = std::make_shared<SegmentBounds>();
  for (found->warps = std::max(threads_per_segment / lanes, 1);; found->warps /= 2) {
    const Id large = gather(bounds, kernel, *found);
    if (found->warps == 1 || large <= (1 - share_that_fits) * mesh.segments()) return found;
  }
}

#define GALE_INSTANTIATE(Space)                                                  \
  template std::shared_ptr<const SegmentBounds> find_segment_bounds(const Mesh&, \
                                                                    const SegmentKernel<MemoryOf<Space>>&, int)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
