#include <algorithm>
#include <exception>
#include <numeric>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/runtime/batches/batch_kernel.hpp>
#include <gale/runtime/defaults.hpp>

namespace gale::detail {

namespace {

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
  const auto greatest = of_parts("GALE::greatest_bound", mesh.segments(), [&](Offset begin, Offset end) {
    StarSizes sizes;
    for_range(begin, end, [&](Offset s) { sizes = larger(sizes, kernel.bound(static_cast<Id>(s))); });
    return sizes;
  });
  return std::accumulate(greatest.begin(), greatest.end(), StarSizes(), larger);
}

/// Gathers, segment after segment, what those need that fit the fast scratch memory together with the ones before.
template <class Memory>
void gather(const std::vector<StarSizes>& bounds, const SegmentKernel<Memory>& kernel, std::size_t fast,
            SegmentBounds& found) {
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
std::shared_ptr<const SegmentBounds> find_bounds(const Mesh& mesh, const SegmentKernel<Memory>& kernel,
                                                 int threads_per_segment, std::size_t fast) {
  const int lanes = is_device_memory<Memory> ? lanes_per_warp : threads_per_segment;
  auto found = std::make_shared<SegmentBounds>();
  found->warps = std::max(threads_per_segment / lanes, 1);
  found->usual = greatest_bound(mesh, kernel);
  found->is_large.assign(mesh.segments(), 0);
  if (kernel.scratch_bytes(found->usual, found->warps) > fast) gather(bounds_of(mesh, kernel), kernel, fast, *found);
  return found;
}

/// Bytes of scratch memory for the teams of one launch whose segments need more than the fast one.
constexpr std::size_t most_scratch = 256 * mebibyte;

/// What Kokkos throws where the device lacks memory for a launch, and not for an illegal access to it.
bool says_out_of_memory(const std::exception& error) {
  const std::string what = error.what();
  if (what.find("illegal") != std::string::npos) return false;
  return what.find("memory") != std::string::npos || what.find("Memory") != std::string::npos;
}

/// The launches of one kernel on one batch.
template <class Memory>
class Launches {
 public:
  using Space = typename SegmentKernel<Memory>::Space;

  Launches(const Space& instance, SegmentKernel<Memory>& kernel, const SegmentBounds& bounds, std::size_t fast,
           const KernelTask& task)
      : instance_(instance), kernel_(kernel), bounds_(bounds), fast_(fast), task_(task) {}

  bool all_fast() const { return all_fast_; }

  /// Launches it on the segments at such places in the batch, each in the memory for `sizes`.
  void launch(Id begin, Id end, const StarSizes& sizes) {
    KernelTask part = task_;
    part.sizes = sizes;
    part.scratch_level = is_fast(sizes) ? 0 : 1;
    all_fast_ &= part.scratch_level == 0;
    const Id most =
        part.scratch_level == 0 ? end - begin : static_cast<Id>(std::max<std::size_t>(most_scratch / bytes(sizes), 1));
    for (Id last = begin; begin < end; begin = last) {
      last = end - begin > most ? begin + most : end;
      part.segments = task_.segments.from_place(begin);
      part.pool.directory = task_.pool.directory + Offset(begin) * kernel_.wanted().count();
      kernel_.launch(instance_, part, last - begin, bounds_.warps);
    }
  }

  /// Launches it on the large ones, whose places begin at `begin`, each group in the memory of its greediest.
  void launch_large(Id begin, const LaunchOrder& order, const StarSizes& usual) {
    const Id* const large = order.segments.data() + order.segments.size() - order.large;
    for (Id first = 0, end = 0; first < order.large; first = end) {
      StarSizes sizes = usual;
      for (; end < order.large; ++end) {
        const StarSizes together = larger(sizes, need_of(large[end], usual));
        if (end > first && !is_fast(together) &&
            bytes(together) * static_cast<std::size_t>(end + 1 - first) > most_scratch)
          break;
        sizes = together;
      }
      launch(begin + first, begin + end, sizes);
    }
  }

 private:
  std::size_t bytes(const StarSizes& sizes) const { return kernel_.scratch_bytes(sizes, bounds_.warps); }
  bool is_fast(const StarSizes& sizes) const { return bytes(sizes) <= fast_; }

  /// What a segment needs; it may be large for another kernel alone.
  StarSizes need_of(Id segment, const StarSizes& usual) const {
    return bounds_.is_large[segment] != 0 ? kernel_.bound(segment) : usual;
  }

  const Space& instance_;
  SegmentKernel<Memory>& kernel_;
  const SegmentBounds& bounds_;
  const std::size_t fast_;
  const KernelTask& task_;
  bool all_fast_ = true;
};

}  // namespace

template <class Memory>
BatchKernel<Memory>::BatchKernel(const Mesh& mesh, RelationSet wanted, int threads_per_segment, std::size_t most_fast)
    : kernel_(mesh, wanted), fast_(std::min(most_fast, fast_scratch_bytes<Space>())) {
  const std::size_t fast = is_device_memory<Memory> ? fast_ : most_fast;
  const std::string key = "segment bounds of " + name_of(wanted) + " by " + std::to_string(threads_per_segment) +
                          " threads in " + Memory::name() + " and " + std::to_string(fast) + " bytes";
  bounds_ = std::static_pointer_cast<const SegmentBounds>(
      mesh.kept(key, [&] { return find_bounds(mesh, kernel_, threads_per_segment, fast); }));
}

template <class Memory>
bool BatchKernel<Memory>::launch(const Space& instance, const KernelTask& task, const LaunchOrder& order, Id count,
                                 const StarSizes& least) {
  try {
    Launches<Memory> launches(instance, kernel_, *bounds_, fast_, task);
    const StarSizes usual = larger(bounds_->usual, least);
    const Id others = count - order.large;
    launches.launch(0, others, usual);
    launches.launch_large(others, order, usual);
    return launches.all_fast();
  } catch (const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr || !says_out_of_memory(error)) throw;
    throw OutOfMemory("there is no scratch memory for a batch of " + std::to_string(count) + " segments");
  }
}

#define GALE_INSTANTIATE(Space) template class BatchKernel<MemoryOf<Space>>
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
