#include <algorithm>
#include <mutex>
#include <numeric>

#include <gale/base/device.hpp>
#include <gale/base/memory.hpp>
#include <gale/runtime/batches/batch_lane.hpp>

namespace gale::detail {

namespace {

template <class Memory>
BatchLaneMemory<Memory> new_memory() {
  BatchLaneMemory<Memory> memory;
  if constexpr (is_device_memory<Memory>) memory.instance = make_instance();  // on the host there is one for all
  memory.header = allocate<Array<BatchHeader, Memory>>("GALE::batch_header", 1);
  memory.header_copy = PinnedArray<BatchHeader>(1);
  return memory;
}

/// The memory of BatchLanes that are gone, unless it is large.
template <class Memory>
class KeptMemory {
 public:
  static KeptMemory& instance() {
    static KeptMemory all;
    return all;
  }

  BatchLaneMemory<Memory> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_.empty()) return new_memory<Memory>();
    BatchLaneMemory<Memory> memory = std::move(kept_.back());
    kept_.pop_back();
    return memory;
  }

  void give_back(BatchLaneMemory<Memory> memory) {
    constexpr std::size_t most_kept = 3, most_bytes = std::size_t(48) << 20;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_.size() >= most_kept || memory.bytes() > most_bytes) return;
    if (kept_.empty() && !hooked_) {
      detail::call_at_end([] {
        instance().kept_.clear();
        instance().hooked_ = false;
      });
      hooked_ = true;
    }
    kept_.push_back(std::move(memory));
  }

 private:
  std::mutex mutex_;
  std::vector<BatchLaneMemory<Memory>> kept_;
  bool hooked_ = false;  ///< to Kokkos' end
};

}  // namespace

template <class Memory>
BatchLane<Memory>::BatchLane(const Mesh& mesh, std::shared_ptr<Kernels> kernels, Offset words, BatchReader reader)
    : kernels_(std::move(kernels)),
      reader_(reader),
      memory_(reader == BatchReader::kernels ? KeptMemory<Memory>::instance().take() : new_memory<Memory>()),
      is_worth_keeping_(reader == BatchReader::kernels) {
  const auto intervals = interval_tables<Memory>(mesh);
  for (const auto& kernel : *kernels_) {
    batches_.of[batches_.kernels].relations = kernel.wanted();
    batches_.of[batches_.kernels++].intervals = intervals;
    relations_ += kernel.wanted().count();
  }
  reserve(words, 0);
}

template <class Memory>
BatchLane<Memory>::~BatchLane() {
  if (in_flight_) abandon();
  try {
    if (is_worth_keeping_) KeptMemory<Memory>::instance().give_back(std::move(memory_));
  } catch (...) {  // there is no memory to note it
  }
}

template <class Memory>
void BatchLane<Memory>::abandon() noexcept {
  in_flight_ = false;
  try {
    wait_for(memory_.instance, "GALE::batch_abandoned");
  } catch (...) {
    is_worth_keeping_ = false;  // what is wrong with the device, the next launch will say
  }
}

template <class Memory>
void BatchLane<Memory>::launch(BatchPlan plan) {
  reserve(plan.words, plan.count());
  plan_ = std::move(plan);
  try {
    launch_kernels();
    in_flight_ = true;
  } catch (...) {
    is_worth_keeping_ = false;  // Kokkos may have lost some of the instance's memory
    wait_for(memory_.instance, "GALE::batch_abandoned");
    throw;
  }
}

template <class Memory>
void BatchLane<Memory>::launch_kernels() {
  const SegmentList segments = place_segments();
  *memory_.header_copy.data() = BatchHeader();
  Kokkos::deep_copy(memory_.instance, memory_.header, memory_.header_copy.view());
  Offset* directory = memory_.directory.data();
  for (int k = 0; k < batches_.kernels; ++k) {
    launch_kernel(k, segments, directory);
    directory += Offset(plan_.count()) * batches_.of[k].relations.count();
  }
  Kokkos::deep_copy(memory_.instance, memory_.header_copy.view(), memory_.header);
  if (reader_ == BatchReader::kernels) return;
  const auto entries = static_cast<std::size_t>(plan_.count() * relations_);
  Kokkos::deep_copy(memory_.instance, first_of(memory_.directory_copy.view(), entries),
                    first_of(memory_.directory, entries));
}

template <class Memory>
void BatchLane<Memory>::launch_kernel(int k, SegmentList segments, Offset* directory) {
  const Id count = plan_.count();
  KernelTask task;
  task.segments = segments;
  task.pool = {memory_.words.data(), plan_.words, &memory_.header.data()->used, directory,
               &memory_.header.data()->needed[k]};
  const StarSizes least = plan_.scratch.empty() ? StarSizes() : plan_.scratch[k];
  if (!(*kernels_)[k].launch(memory_.instance, task, order_, count, least))
    is_worth_keeping_ = false;  // nor what its instance takes for that
  Batch<Memory>& batch = batches_.of[k];
  batch.count = count;
  batch.segments = segments;
  batch.directory = directory;
  batch.words = memory_.words.data();
}

/// Orders the segments, and puts them where the kernels read them, unless they are an interval of which none is large.
template <class Memory>
SegmentList BatchLane<Memory>::place_segments() {
  order_ = LaunchOrder();
  Id small = 0;
  while (small < plan_.count() && !is_large(plan_.segment(small))) ++small;
  if (plan_.is_interval() && small == plan_.count()) return SegmentList::from(plan_.begin);
  std::vector<Id>& segments = order_.segments;
  segments = plan_.segments;
  if (plan_.is_interval()) {
    segments.resize(plan_.count());
    std::iota(segments.begin(), segments.end(), plan_.begin);
  }
  const auto first_large = std::stable_partition(segments.begin() + small, segments.end(),
                                                 [this](Id segment) { return !is_large(segment); });
  order_.large = static_cast<Id>(segments.end() - first_large);
  std::copy(segments.begin(), segments.end(), memory_.segments_copy.data());
  Kokkos::deep_copy(memory_.instance, first_of(memory_.segments, segments.size()),
                    first_of(memory_.segments_copy.view(), segments.size()));
  return memory_.segments.data();
}

template <class Memory>
bool BatchLane<Memory>::is_large(Id segment) const {
  return std::any_of(kernels_->begin(), kernels_->end(),
                     [segment](const auto& kernel) { return kernel.is_large(segment); });
}

template <class Memory>
void BatchLane<Memory>::begin_copy(const PinnedArray<Id>& words) {
  wait_for(memory_.instance, "GALE::batch_computed");
  const auto used = static_cast<std::size_t>(std::min(memory_.header_copy.data()->used, plan_.words));
  Kokkos::deep_copy(memory_.instance, first_of(words.view(), used), first_of(memory_.words, used));
}

template <class Memory>
BatchShortfall BatchLane<Memory>::finish() {
  wait_for(memory_.instance, "GALE::batch_finished");
  in_flight_ = false;
  const BatchHeader& header = *memory_.header_copy.data();
  BatchShortfall lacked;
  lacked.words = header.used;
  bool all = header.used <= plan_.words;
  for (int k = 0; k < batches_.kernels; ++k) {
    lacked.scratch.push_back(header.needed[k]);
    all &= header.needed[k].rows == 0;
  }
  if (!all || reader_ == BatchReader::host) lacked.segments = segments_missing();
  return lacked;
}

template <class Memory>
std::vector<Id> BatchLane<Memory>::segments_missing() const {
  const auto entries = static_cast<std::size_t>(plan_.count() * relations_);
  Array<Offset, HostMemory> brought;
  if (reader_ == BatchReader::kernels)
    brought = Kokkos::create_mirror_view_and_copy(HostMemory(), first_of(memory_.directory, entries));
  const Offset* entry = reader_ == BatchReader::host ? directory() : brought.data();
  std::vector<std::uint8_t> there(plan_.count(), 1);
  for (int k = 0; k < batches_.kernels; ++k) {
    const RelationSet relations = batches_.of[k].relations;
    for (Id slot = 0; slot < plan_.count(); ++slot, entry += relations.count()) {
      const Id one = segment(slot);
      there[slot] &= are_there(Batch<HostMemory>{relations, 1, &one, entry, nullptr, {}});
    }
  }
  std::vector<Id> missing;
  for (Id slot = 0; slot < plan_.count(); ++slot) {
    if (!there[slot]) missing.push_back(segment(slot));
  }
  return missing;
}

template <class Memory>
void BatchLane<Memory>::reserve(Offset words, Id slots) {
  const auto grow = [](auto& array, const char* label, Offset size) {
    if (static_cast<Offset>(array.extent(0)) >= size) return;
    array = {};
    array = allocate<std::decay_t<decltype(array)>>(label, size);
  };
  room_ = std::max(room_, words);
  grow(memory_.words, "GALE::batch_words", words);
  grow(memory_.segments, "GALE::batch_segments", slots);
  if (memory_.segments_copy.size() < memory_.segments.extent(0))
    memory_.segments_copy = PinnedArray<Id>(memory_.segments.extent(0));
  grow(memory_.directory, "GALE::batch_directory", slots * relations_);
  if (reader_ == BatchReader::host && memory_.directory_copy.size() < memory_.directory.extent(0))
    memory_.directory_copy = PinnedArray<Offset>(memory_.directory.extent(0));
}

#define GALE_INSTANTIATE(Space) template class BatchLane<MemoryOf<Space>>
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
