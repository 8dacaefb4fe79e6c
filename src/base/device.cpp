#include <cstring>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/device.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>

#if defined(KOKKOS_ENABLE_CUDA)

#include <cuda_runtime_api.h>

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_segmented_sort.cuh>

namespace gale {

namespace {

void require_success(cudaError_t status, const std::string& what) {
  if (status != cudaSuccess) throw Error(what + " failed: " + cudaGetErrorString(status));
}

/// The bits in which some of the keys differ: each eight of them take a pass.
std::uint64_t differing_bits(const WorkerSpace& space, const Array<std::uint64_t, WorkerMemory>& keys) {
  std::uint64_t all = 0;
  Kokkos::parallel_reduce(
      "GALE::sort_bits", detail::device_range(space, keys.extent(0)),
      KOKKOS_LAMBDA(Offset i, std::uint64_t & bits) { bits |= keys(i) ^ keys(0); }, Kokkos::BOr<std::uint64_t>(all));
  return all;
}

}  // namespace

void use_device() { cudaSetDevice(WorkerSpace().cuda_device()); }

std::optional<std::string> device_name() { return std::string(WorkerSpace().cuda_device_prop().name); }

WorkerSpace make_instance() {
  try {
    return Kokkos::Experimental::partition_space(WorkerSpace(), std::vector<int>{1})[0];
  } catch (const std::exception& error) {
    cudaGetLastError();  // what this leaves behind is not the next call's
    if (std::string(error.what()).find("cudaErrorMemoryAllocation") == std::string::npos) throw;
    throw OutOfMemory("Cuda has no memory for another instance");
  }
}

bool detail::lock_pages(void* memory, std::size_t bytes) {
  use_device();
  if (cudaHostRegister(memory, bytes, cudaHostRegisterDefault) == cudaSuccess) return true;
  cudaGetLastError();
  return false;
}

void detail::unlock_pages(void* memory) { cudaHostUnregister(memory); }

detail::CopyStream::CopyStream() {
  cudaStream_t stream = nullptr;
  require_success(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "a copy to or from the device");
  stream_ = stream;
}

detail::CopyStream::~CopyStream() {
  if (stream_ != nullptr) cudaStreamDestroy(static_cast<cudaStream_t>(stream_));
}

void detail::CopyStream::begin_copy(void* to, const void* from, std::size_t bytes) const {
  use_device();
  require_success(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, static_cast<cudaStream_t>(stream_)),
                  "a copy to or from the device");
}

void detail::CopyStream::wait() const {
  use_device();
  require_success(cudaStreamSynchronize(static_cast<cudaStream_t>(stream_)), "a copy to or from the device");
}

void detail::sort_by_key_on_device(const WorkerSpace& space, const Array<std::uint64_t, WorkerMemory>& keys,
                                   const Array<Id, WorkerMemory>& values) {
  const auto n = static_cast<std::int64_t>(keys.extent(0));
  const std::uint64_t bits = differing_bits(space, keys);
  if (bits == 0) return;
  const int first_bit = lowest_bit(bits), end_bit = highest_bit(bits) + 1;
  cub::DoubleBuffer<std::uint64_t> key_buffer(keys.data(), nullptr);
  cub::DoubleBuffer<Id> value_buffer(values.data(), nullptr);
  const auto sort = [&](void* workspace, std::size_t& bytes) {
    require_success(cub::DeviceRadixSort::SortPairs(workspace, bytes, key_buffer, value_buffer, n, first_bit, end_bit,
                                                    space.cuda_stream()),
                    "GALE::sort_by_key on the device");
  };
  std::size_t bytes = 0;
  sort(nullptr, bytes);
  // One piece of memory for all: to take one and give it back costs as much as a pass or two.
  constexpr std::size_t alignment = 256;
  const auto aligned = [](std::size_t size) { return (size + alignment - 1) / alignment * alignment; };
  const std::size_t key_bytes = aligned(n * sizeof(std::uint64_t)), value_bytes = aligned(n * sizeof(Id));
  const auto memory = allocate<Array<char, WorkerMemory>>("GALE::sort_by_key", key_bytes + value_bytes + bytes);
  const Array<std::uint64_t, WorkerMemory> other_keys(reinterpret_cast<std::uint64_t*>(memory.data()), n);
  const Array<Id, WorkerMemory> other_values(reinterpret_cast<Id*>(memory.data() + key_bytes), n);
  key_buffer.d_buffers[1] = other_keys.data();
  value_buffer.d_buffers[1] = other_values.data();
  sort(memory.data() + key_bytes + value_bytes, bytes);
  if (key_buffer.Current() != keys.data()) Kokkos::deep_copy(space, keys, other_keys);
  if (value_buffer.Current() != values.data()) Kokkos::deep_copy(space, values, other_values);
}

template <class Index>
void detail::sort_rows_on_device(const WorkerSpace& space, const char* label, const Array<Index, WorkerMemory>& begin,
                                 const Array<Id, WorkerMemory>& values) {
  const auto rows = static_cast<Offset>(begin.extent(0)) - 1;
  const auto other = allocate<Array<Id, WorkerMemory>>("GALE::sort_rows", values.extent(0));
  cub::DoubleBuffer<Id> buffer(values.data(), other.data());
  const auto sort = [&](void* workspace, std::size_t& bytes) {
    require_success(cub::DeviceSegmentedSort::SortKeys(workspace, bytes, buffer, static_cast<Offset>(values.extent(0)),
                                                       rows, begin.data(), begin.data() + 1, space.cuda_stream()),
                    std::string(label) + " on the device");
  };
  std::size_t bytes = 0;
  sort(nullptr, bytes);
  const auto workspace = allocate<Array<char, WorkerMemory>>(label, bytes);
  sort(workspace.data(), bytes);
  if (buffer.Current() != values.data()) Kokkos::deep_copy(space, values, other);
}

template void detail::sort_rows_on_device(const WorkerSpace&, const char*, const Array<Id, WorkerMemory>&,
                                          const Array<Id, WorkerMemory>&);
template void detail::sort_rows_on_device(const WorkerSpace&, const char*, const Array<Offset, WorkerMemory>&,
                                          const Array<Id, WorkerMemory>&);

}  // namespace gale

#else

namespace gale {

void use_device() {}
std::optional<std::string> device_name() { return std::nullopt; }
WorkerSpace make_instance() { return {}; }

bool detail::lock_pages(void*, std::size_t) { return true; }
void detail::unlock_pages(void*) {}

detail::CopyStream::CopyStream() = default;
detail::CopyStream::~CopyStream() = default;
void detail::CopyStream::begin_copy(void* to, const void* from, std::size_t bytes) const {
  std::memcpy(to, from, bytes);
}
void detail::CopyStream::wait() const {}

}  // namespace gale

#endif

gale::detail::CopyStream::CopyStream(CopyStream&& other) noexcept : stream_(std::exchange(other.stream_, nullptr)) {}
