#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/device.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>

namespace gale {

namespace {

constexpr std::size_t page_bytes = 4096;

/// Has the system give all pages, by one thread or, where there are many, by all.
void touch(void* memory, std::size_t size) {
  constexpr std::size_t many = std::size_t(16) << 20;
  volatile char* const bytes = static_cast<volatile char*>(memory);
  const auto touch_page = [bytes](Offset i) { bytes[static_cast<std::size_t>(i) * page_bytes] = 0; };
  const auto pages = static_cast<Offset>(size / page_bytes);
  if (size >= many) {
    parallel_for("GALE::touch_pinned", Kokkos::DefaultHostExecutionSpace(), pages, touch_page);
  } else {
    for (Offset i = 0; i < pages; ++i) touch_page(i);
  }
}

/// The driver's own way takes ten times as long. Without a device nobody needs it.
[[maybe_unused]] std::shared_ptr<void> allocate_locked_pages(std::size_t bytes) {
  const std::size_t size = (bytes + page_bytes) / page_bytes * page_bytes;
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const auto refuse = [size] {
    throw OutOfMemory("the host has no " + std::to_string(size) + " bytes of page-locked memory");
  };
  if (memory == MAP_FAILED) refuse();
  detail::advise_huge_pages(memory, size);
  touch(memory, size);
  if (!detail::lock_pages(memory, size)) {
    munmap(memory, size);
    refuse();
  }
  return {memory, [size](void* at) {
            detail::unlock_pages(at);
            munmap(at, size);
          }};
}

constexpr std::size_t chunk_bytes = std::size_t(2) << 20;

/// Enough for some to fill or empty their chunks while those of others travel.
constexpr int most_lanes = 16;

/// One thread's way to the device and back, and the pinned memory that it goes through.
struct CopyLane {
  detail::CopyStream stream;
  PinnedArray<char> chunk;
};

/// The lanes of the process, which live until Kokkos is finalized: pinning memory takes longer than most copies.
class CopyLanes {
 public:
  static CopyLanes& instance() {
    static CopyLanes lanes;
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
    for (int i = 0; i < missing; ++i)
      lanes_.push_back({detail::CopyStream(), chunks.slice(i * chunk_bytes, chunk_bytes)});
  }

  std::mutex mutex_;
  std::vector<CopyLane> lanes_;
};

}  // namespace

std::shared_ptr<void> detail::allocate_pinned_bytes(std::size_t bytes) {
  if constexpr (have_device) {
    return allocate_locked_pages(bytes);
  } else {
    try {
      return {::operator new(bytes), [](void* at) { ::operator delete(at); }};
    } catch (const std::bad_alloc&) {
      throw OutOfMemory("the host has no " + std::to_string(bytes) + " bytes for a batch");
    }
  }
}

void prepare_copies(int threads) { CopyLanes::instance().prepare(threads); }

void write_to_device(void* device, std::size_t bytes,
                     const std::function<void(char* to, std::size_t begin, std::size_t size)>& write) {
  detail::wait_for(WorkerSpace(), "GALE::copy");
  CopyLanes::instance().for_pieces(bytes, [&](const CopyLane& lane, std::size_t begin, std::size_t size) {
    write(lane.chunk.data(), begin, size);
    lane.stream.copy(static_cast<char*>(device) + begin, lane.chunk.data(), size);
  });
}

void copy_to_device(void* device, const void* host, std::size_t bytes) {
  write_to_device(device, bytes, [host](char* to, std::size_t begin, std::size_t size) {
    std::memcpy(to, static_cast<const char*>(host) + begin, size);
  });
}

void copy_from_device(void* host, const void* device, std::size_t bytes) {
  detail::wait_for(WorkerSpace(), "GALE::copy");
  CopyLanes::instance().for_pieces(bytes, [&](const CopyLane& lane, std::size_t begin, std::size_t size) {
    lane.stream.copy(lane.chunk.data(), static_cast<const char*>(device) + begin, size);
    std::memcpy(static_cast<char*>(host) + begin, lane.chunk.data(), size);
  });
}

}  // namespace gale
