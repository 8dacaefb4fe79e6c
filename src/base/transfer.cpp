#include <gale/base/error.hpp>
#include <gale/base/transfer.hpp>

#if defined(KOKKOS_ENABLE_CUDA)

#include <cuda_runtime_api.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/pinned.hpp>
#include <gale/base/threads.hpp>

namespace gale {

namespace {

constexpr std::size_t chunk_bytes = std::size_t(2) << 20;

/// Enough for some to fill or empty their chunks while those of others travel.
constexpr int most_lanes = 16;

void require(cudaError_t status) {
  if (status != cudaSuccess)
    throw Error(std::string("a copy to or from the device failed: ") + cudaGetErrorString(status));
}

/// One thread's way to the device and back. A stream alone: an instance of Kokkos::Cuda takes ten times as long to
/// make.
class Lane {
 public:
  explicit Lane(const PinnedArray<char>& chunk) : chunk_(chunk) {
    require(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
  }
  Lane(Lane&& other) noexcept : chunk_(other.chunk_), stream_(std::exchange(other.stream_, nullptr)) {}
  Lane& operator=(Lane&&) = delete;
  ~Lane() {
    if (stream_ != nullptr) cudaStreamDestroy(stream_);
  }

  char* chunk() const { return chunk_.data(); }

  /// Between the chunk and the device, one of which is `to`.
  void copy(void* to, const void* from, std::size_t bytes) const {
    use_device();
    require(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, stream_));
    require(cudaStreamSynchronize(stream_));
  }

 private:
  PinnedArray<char> chunk_;
  cudaStream_t stream_ = nullptr;
};

/// The lanes of the process, which live until Kokkos is finalized: pinning memory takes longer than most copies.
class Lanes {
 public:
  static Lanes& instance() {
    static Lanes lanes;
    return lanes;
  }

  void prepare(int threads) {
    const std::lock_guard<std::mutex> lock(mutex_);
    add_lanes(std::min(threads, most_lanes));
  }

  /// Calls copy(lane, begin, size) for the pieces of `bytes` bytes, each of a chunk at most.
  template <class Copy>
  void for_pieces(std::size_t bytes, const Copy& copy) {
    const std::size_t chunks = (bytes + chunk_bytes - 1) / chunk_bytes;
    const int threads = static_cast<int>(std::min<std::size_t>(chunks, std::min(host_threads(), most_lanes)));
    if (threads == 0) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    add_lanes(threads);
    std::atomic<std::size_t> next{0};
    on_threads(threads, [&](int thread) {
      for (std::size_t chunk; (chunk = next++) < chunks;) {
        detail::stop_if_asked();
        const std::size_t begin = chunk * chunk_bytes;
        copy(lanes_[thread], begin, std::min(chunk_bytes, bytes - begin));
      }
    });
  }

 private:
  /// New lanes take their chunks from one array: pinning costs more by the call than by the byte.
  void add_lanes(int count) {
    const int missing = count - static_cast<int>(lanes_.size());
    if (missing <= 0) return;
    use_device();
    if (lanes_.empty()) Kokkos::push_finalize_hook([this] { lanes_.clear(); });
    const PinnedArray<char> chunks(static_cast<std::size_t>(missing) * chunk_bytes);
    for (int i = 0; i < missing; ++i) lanes_.emplace_back(chunks.slice(i * chunk_bytes, chunk_bytes));
  }

  std::mutex mutex_;
  std::vector<Lane> lanes_;
};

}  // namespace

void prepare_copies(int threads) { Lanes::instance().prepare(threads); }

void write_to_device(void* device, std::size_t bytes,
                     const std::function<void(char* to, std::size_t begin, std::size_t size)>& write) {
  WorkerSpace().fence("GALE::copy");
  Lanes::instance().for_pieces(bytes, [&](const Lane& lane, std::size_t begin, std::size_t size) {
    write(lane.chunk(), begin, size);
    lane.copy(static_cast<char*>(device) + begin, lane.chunk(), size);
  });
}

void copy_to_device(void* device, const void* host, std::size_t bytes) {
  write_to_device(device, bytes, [host](char* to, std::size_t begin, std::size_t size) {
    std::memcpy(to, static_cast<const char*>(host) + begin, size);
  });
}

void copy_from_device(void* host, const void* device, std::size_t bytes) {
  WorkerSpace().fence("GALE::copy");
  Lanes::instance().for_pieces(bytes, [&](const Lane& lane, std::size_t begin, std::size_t size) {
    lane.copy(lane.chunk(), static_cast<const char*>(device) + begin, size);
    std::memcpy(static_cast<char*>(host) + begin, lane.chunk(), size);
  });
}

}  // namespace gale

#else

namespace gale {

void prepare_copies(int) {}
void write_to_device(void*, std::size_t, const std::function<void(char*, std::size_t, std::size_t)>&) {
  throw Error("this Kokkos has no device to write to");
}
void copy_to_device(void*, const void*, std::size_t) { throw Error("this Kokkos has no device to copy to"); }
void copy_from_device(void*, const void*, std::size_t) { throw Error("this Kokkos has no device to copy from"); }

}  // namespace gale

#endif
