#include <gale/base/error.hpp>
#include <gale/base/transfer.hpp>

#if defined(KOKKOS_ENABLE_CUDA)

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include <gale/base/pinned.hpp>
#include <gale/base/threads.hpp>

namespace gale {

namespace {

using Bytes = Kokkos::View<char*, WorkerMemory, Kokkos::MemoryUnmanaged>;
using Pinned = PinnedArray<char>;

constexpr std::size_t chunk_bytes = std::size_t(2) << 20;

/// Enough for some to fill or empty their chunks while those of others travel.
constexpr int most_lanes = 16;

/// One thread's way to the device and back.
struct Lane {
  WorkerSpace instance = make_instance();
  Pinned chunk{chunk_bytes};
};

/// The lanes of the process, which live until Kokkos is finalized: pinning memory takes longer than most copies.
class Lanes {
 public:
  static Lanes& instance() {
    static Lanes lanes;
    return lanes;
  }

  /// Calls copy(lane, begin, size) for the pieces of `bytes` bytes, each of a chunk at most.
  template <class Copy>
  void for_pieces(std::size_t bytes, const Copy& copy) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t chunks = (bytes + chunk_bytes - 1) / chunk_bytes;
    const int threads = static_cast<int>(std::min<std::size_t>(chunks, std::min(host_threads(), most_lanes)));
    if (threads == 0) return;
    prepare(threads);
    std::atomic<std::size_t> next{0};
    on_threads(threads, [&](int thread) {
      for (std::size_t chunk; (chunk = next++) < chunks;) {
        const std::size_t begin = chunk * chunk_bytes;
        copy(*lanes_[thread], begin, std::min(chunk_bytes, bytes - begin));
      }
    });
  }

 private:
  void prepare(int count) {
    if (lanes_.empty()) Kokkos::push_finalize_hook([this] { lanes_.clear(); });
    while (static_cast<int>(lanes_.size()) < count) lanes_.push_back(std::make_unique<Lane>());
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Lane>> lanes_;
};

auto first(const Pinned& chunk, std::size_t size) {
  return Kokkos::subview(chunk.view(), std::make_pair(std::size_t(0), size));
}

}  // namespace

void copy_to_device(void* device, const void* host, std::size_t bytes) {
  WorkerSpace().fence("GALE::copy");
  Lanes::instance().for_pieces(bytes, [&](const Lane& lane, std::size_t begin, std::size_t size) {
    std::memcpy(lane.chunk.data(), static_cast<const char*>(host) + begin, size);
    Kokkos::deep_copy(lane.instance, Bytes(static_cast<char*>(device) + begin, size), first(lane.chunk, size));
    lane.instance.fence();
  });
}

void copy_from_device(void* host, const void* device, std::size_t bytes) {
  WorkerSpace().fence("GALE::copy");
  Lanes::instance().for_pieces(bytes, [&](const Lane& lane, std::size_t begin, std::size_t size) {
    char* const from = const_cast<char*>(static_cast<const char*>(device)) + begin;
    Kokkos::deep_copy(lane.instance, first(lane.chunk, size), Bytes(from, size));
    lane.instance.fence();
    std::memcpy(static_cast<char*>(host) + begin, lane.chunk.data(), size);
  });
}

}  // namespace gale

#else

namespace gale {

void copy_to_device(void*, const void*, std::size_t) { throw Error("this Kokkos has no device to copy to"); }
void copy_from_device(void*, const void*, std::size_t) { throw Error("this Kokkos has no device to copy from"); }

}  // namespace gale

#endif
