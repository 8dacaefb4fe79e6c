#include <algorithm>

#include <gale/base/memory.hpp>
#include <gale/runtime/device/batch_lane.hpp>

namespace gale::detail {

template <class Memory>
BatchLane<Memory>::BatchLane(const Mesh& mesh, std::vector<SweepKernel<Memory>>& kernels, Offset words)
    : kernels_(kernels), words_(words), memory_(KeptLanes<Memory>::instance().take()) {
  const auto intervals = interval_tables<Memory>(mesh);
  for (const auto& one : kernels_) {
    batches_.of[batches_.kernels].relations = one.kernel.wanted();
    batches_.of[batches_.kernels++].intervals = intervals;
    relations_ += one.kernel.wanted().count();
  }
  reserve(words_, 0);
}

template <class Memory>
BatchLane<Memory>::~BatchLane() {
  try {
    if (in_flight_) memory_.instance.fence();
    if (is_worth_keeping_) KeptLanes<Memory>::instance().give_back(std::move(memory_));
  } catch (...) {
    // What is wrong with the device, the next launch will say.
  }
}

template <class Memory>
void BatchLane<Memory>::launch(BatchPlan plan) {
  plan.words = std::max(plan.words, words_);
  reserve(plan.words, plan.count());
  plan_ = std::move(plan);
  try {
    launch_kernels();
    in_flight_ = true;
  } catch (...) {
    is_worth_keeping_ = false;  // Kokkos may have lost some of the instance's memory
    memory_.instance.fence();
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
}

template <class Memory>
void BatchLane<Memory>::launch_kernel(int k, SegmentList segments, Offset* directory) {
  const Id count = plan_.count();
  SegmentKernel<Memory>& kernel = kernels_[k].kernel;
  KernelTask task;
  task.segments = segments;
  task.pool = {memory_.words.data(), plan_.words, &memory_.header.data()->used, directory,
               &memory_.header.data()->needed[k]};
  const StarSizes least = plan_.scratch.empty() ? StarSizes() : plan_.scratch[k];
  if (!launch_batch(memory_.instance, kernel, *kernels_[k].bounds, task, plan_.order, count, least))
    is_worth_keeping_ = false;  // nor what its instance takes for that
  Batch<Memory>& batch = batches_.of[k];
  batch.count = count;
  batch.segments = segments;
  batch.directory = directory;
  batch.words = memory_.words.data();
}

template <class Memory>
BatchShortfall BatchLane<Memory>::finish() {
  memory_.instance.fence();
  in_flight_ = false;
  const BatchHeader& header = *memory_.header_copy.data();
  BatchShortfall lacked;
  lacked.words = header.used;
  bool all = header.used <= plan_.words;
  for (int k = 0; k < batches_.kernels; ++k) {
    lacked.scratch.push_back(header.needed[k]);
    all &= header.needed[k].rows == 0;
  }
  if (!all) lacked.segments = segments_missing();
  return lacked;
}

template <class Memory>
std::vector<Id> BatchLane<Memory>::segments_missing() const {
  const auto entries = static_cast<std::size_t>(plan_.count() * relations_);
  const auto directory = Kokkos::create_mirror_view_and_copy(HostMemory(), first_of(memory_.directory, entries));
  std::vector<std::uint8_t> there(plan_.count(), 1);
  const Offset* entry = directory.data();
  for (int k = 0; k < batches_.kernels; ++k) {
    const RelationSet relations = batches_.of[k].relations;
    for (Id slot = 0; slot < plan_.count(); ++slot, entry += relations.count()) {
      const Id segment = plan_.segment(slot);
      there[slot] &= are_there(Batch<HostMemory>{relations, 1, &segment, entry, nullptr, {}});
    }
  }
  std::vector<Id> missing;
  for (Id slot = 0; slot < plan_.count(); ++slot) {
    if (!there[slot]) missing.push_back(plan_.segment(slot));
  }
  return missing;
}

/// Where the kernels read their segments.
template <class Memory>
SegmentList BatchLane<Memory>::place_segments() {
  if (plan_.is_interval()) return SegmentList::from(plan_.begin);
  const std::size_t count = plan_.order.segments.size();
  std::copy(plan_.order.segments.begin(), plan_.order.segments.end(), memory_.segments_copy.data());
  Kokkos::deep_copy(memory_.instance, first_of(memory_.segments, count), first_of(memory_.segments_copy.view(), count));
  return memory_.segments.data();
}

template <class Memory>
void BatchLane<Memory>::reserve(Offset words, Id slots) {
  const auto grow = [](auto& array, const char* label, Offset size) {
    if (static_cast<Offset>(array.extent(0)) >= size) return;
    array = {};
    array = allocate<std::decay_t<decltype(array)>>(label, size);
  };
  grow(memory_.words, "GALE::sweep_words", words);
  grow(memory_.segments, "GALE::sweep_segments", slots);
  if (memory_.segments_copy.size() < memory_.segments.extent(0))
    memory_.segments_copy = PinnedArray<Id>(memory_.segments.extent(0));
  grow(memory_.directory, "GALE::sweep_directory", slots * relations_);
}

template class BatchLane<WorkerMemory>;
#if defined(KOKKOS_ENABLE_CUDA)
template class BatchLane<HostMemory>;
#endif

}  // namespace gale::detail
