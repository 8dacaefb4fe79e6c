#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <gale/base/parallel.hpp>
#include <gale/runtime/segment_bounds.hpp>

namespace gale::detail {

namespace {

/// Bytes of scratch memory within which a segment isn't large.
template <class Memory>
std::size_t fast_bytes() {
  return is_device_memory<Memory> ? fast_scratch_bytes<WorkerSpace>() : std::numeric_limits<std::size_t>::max();
}

template <class Memory>
std::vector<StarSizes> bounds_of(const Mesh& mesh, const SegmentKernel<Memory>& kernel) {
  std::vector<StarSizes> bounds(mesh.segments());
  parallel_for("GALE::segment_bounds", Kokkos::DefaultHostExecutionSpace(), mesh.segments(),
               [&](Offset s) { bounds[s] = kernel.bound(static_cast<Id>(s)); });
  return bounds;
}

/// What suffices for every segment.
template <class Memory>
StarSizes greatest_bound(const Mesh& mesh, const SegmentKernel<Memory>& kernel) {
  const int threads = detail::threads_for(mesh.segments());
  std::vector<StarSizes> greatest(threads);
  for_parts("GALE::greatest_bound", mesh.segments(), threads, [&](int thread, Offset begin, Offset end) {
    StarSizes sizes;
    for (Offset s = begin; s < end; ++s) {
      detail::stop_if_asked_at(s);
      sizes = larger(sizes, kernel.bound(static_cast<Id>(s)));
    }
    greatest[thread] = sizes;
  });
  return std::accumulate(greatest.begin(), greatest.end(), StarSizes(), larger);
}

/// Gathers, segment after segment, what those need that fit the fast scratch memory together with the ones before.
template <class Memory>
void gather(const std::vector<StarSizes>& bounds, const SegmentKernel<Memory>& kernel, SegmentBounds& found) {
  const std::size_t fast = fast_bytes<Memory>();
  found.usual = StarSizes();
  for (std::size_t s = 0; s < bounds.size(); ++s) {
    if (found.usual.contains(bounds[s])) continue;
    const StarSizes together = larger(found.usual, bounds[s]);
    if (kernel.scratch_bytes(together, found.warps) <= fast) {
      found.usual = together;
    } else {
      found.is_large[s] = 1;
    }
  }
}

template <class Memory>
std::shared_ptr<const SegmentBounds> find(const Mesh& mesh, const SegmentKernel<Memory>& kernel,
                                          int threads_per_segment) {
  const int lanes = is_device_memory<Memory> ? 32 : threads_per_segment;
  auto found = std::make_shared<SegmentBounds>();
  found->warps = std::max(threads_per_segment / lanes, 1);
  found->usual = greatest_bound(mesh, kernel);
  found->is_large.assign(mesh.segments(), 0);
  if (kernel.scratch_bytes(found->usual, found->warps) > fast_bytes<Memory>())
    gather(bounds_of(mesh, kernel), kernel, *found);
  return found;
}

}  // namespace

template <class Memory>
std::shared_ptr<const SegmentBounds> segment_bounds(const Mesh& mesh, const SegmentKernel<Memory>& kernel,
                                                    int threads_per_segment) {
  const std::string key = "segment bounds of " + name_of(kernel.wanted()) + " by " +
                          std::to_string(threads_per_segment) + " threads in " + Memory::name();
  return std::static_pointer_cast<const SegmentBounds>(
      mesh.kept(key, [&] { return find(mesh, kernel, threads_per_segment); }));
}

#define GALE_INSTANTIATE(Space) \
  template std::shared_ptr<const SegmentBounds> segment_bounds(const Mesh&, const SegmentKernel<MemoryOf<Space>>&, int)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
