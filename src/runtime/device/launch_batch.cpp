#include <exception>
#include <string>

#include <gale/base/error.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/device/launch_batch.hpp>

namespace gale::detail {

namespace {

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

  Launches(const Space& instance, SegmentKernel<Memory>& kernel, const SegmentBounds& bounds, const KernelTask& task)
      : instance_(instance), kernel_(kernel), bounds_(bounds), task_(task) {}

  bool all_fast() const { return all_fast_; }

  /// On the segments at such places in the batch, each in the memory for `sizes`.
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

  /// On the large ones, whose places begin at `begin`, each group in the memory of its greediest.
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
  const KernelTask& task_;
  const std::size_t fast_ = fast_scratch_bytes<Space>();
  bool all_fast_ = true;
};

}  // namespace

template <class Memory>
bool launch_batch(const typename SegmentKernel<Memory>::Space& instance, SegmentKernel<Memory>& kernel,
                  const SegmentBounds& bounds, const KernelTask& task, const LaunchOrder& order, Id count,
                  const StarSizes& least) {
  try {
    Launches<Memory> launches(instance, kernel, bounds, task);
    const StarSizes usual = larger(bounds.usual, least);
    const Id others = count - order.large;
    launches.launch(0, others, usual);
    launches.launch_large(others, order, usual);
    return launches.all_fast();
  } catch (const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr || !says_out_of_memory(error)) throw;
    throw OutOfMemory("there is no scratch memory for a batch of " + std::to_string(count) + " segments");
  }
}

#define GALE_INSTANTIATE(Space)                                                                                      \
  template bool launch_batch(const Space&, SegmentKernel<MemoryOf<Space>>&, const SegmentBounds&, const KernelTask&, \
                             const LaunchOrder&, Id, const StarSizes&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
