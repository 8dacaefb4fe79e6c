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

/// A thread writes one half of its chunk while the other travels. Halves fit a core's cache, so that what is written
/// costs no bandwidth of the host's memory.
constexpr std::size_t half_bytes = std::size_t(1) << 20, chunk_bytes = 2 * half_bytes;

/// Enough for some to fill or empty their chunks while those of others travel.
constexpr int most_channels = 16;

/// One thread's way to the device and back, and the pinned memory that it goes through.
struct CopyChannel {
  PinnedArray<char> chunk;
  detail::CopyStream streams[2];  ///< of its halves

  /// Waits for all copies that have begun.
  void wait() const {
    for (const detail::CopyStream& stream : streams) stream.wait();
  }
};

/// The channels of the process, which live until Kokkos is finalized: pinning memory takes longer than most copies.
class CopyChannels {
 public:
  static CopyChannels& instance() {
    static CopyChannels channels;
    return channels;
  }

  void prepare(int threads) {
    const std::lock_guard<std::mutex> lock(mutex_);
    add_channels(std::min(threads, most_channels));
  }

  /// Calls copy(channel, begin, size) for the pieces of `bytes` bytes, each of a chunk at most. Returns when all copies
  /// that these calls begin are done.
  template <class Copy>
  void for_pieces(std::size_t bytes, const Copy& copy) {
    const std::size_t chunks = (bytes + chunk_bytes - 1) / chunk_bytes;
    const int threads = static_cast<int>(std::min<std::size_t>(chunks, std::min(host_threads(), most_channels)));
    if (threads == 0) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    add_channels(threads);
    std::atomic<std::size_t> next{0};
    on_threads(threads, [&](int thread) {
      const CopyChannel& channel = channels_[thread];
      try {
        for (std::size_t chunk; (chunk = next++) < chunks;) {
          detail::stop_if_asked();
          const std::size_t begin = chunk * chunk_bytes;
          copy(channel, begin, std::min(chunk_bytes, bytes - begin));
        }
      } catch (...) {
        channel.wait();  // the caller may free what they write to
        throw;
      }
      channel.wait();
    });
  }

 private:
  /// New channels take their chunks from one array: pinning costs more by the call than by the byte.
  void add_channels(int count) {
    const int missing = count - static_cast<int>(channels_.size());
    if (missing <= 0) return;
    use_device();
    if (channels_.empty()) Kokkos::push_finalize_hook([this] { channels_.clear(); });
    const PinnedArray<char> chunks(static_cast<std::size_t>(missing) * chunk_bytes);
    for (int i = 0; i < missing; ++i) channels_.push_back({chunks.slice(i * chunk_bytes, chunk_bytes), {}});
  }

  std::mutex mutex_;
  std::vector<CopyChannel> channels_;
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

void prepare_copies(int threads) { CopyChannels::instance().prepare(threads); }

void write_to_device(void* device, std::size_t bytes,
                     const std::function<void(char* to, std::size_t begin, std::size_t size)>& write) {
  detail::wait_for(WorkerSpace(), "GALE::copy");
  CopyChannels::instance().for_pieces(bytes, [&](const CopyChannel& channel, std::size_t begin, std::size_t size) {
    for (std::size_t from = 0; from < size; from += half_bytes) {
      const std::size_t count = std::min(half_bytes, size - from);
      const detail::CopyStream& stream = channel.streams[from / half_bytes];
      char* const half = channel.chunk.data() + from;
      stream.wait();
      write(half, begin + from, count);
      stream.begin_copy(static_cast<char*>(device) + begin + from, half, count);
    }
  });
}

void copy_to_device(void* device, const void* host, std::size_t bytes) {
  write_to_device(device, bytes, [host](char* to, std::size_t begin, std::size_t size) {
    std::memcpy(to, static_cast<const char*>(host) + begin, size);
  });
}

void copy_from_device(void* host, const void* device, std::size_t bytes) {
  detail::wait_for(WorkerSpace(), "GALE::copy");
  CopyChannels::instance().for_pieces(bytes, [&](const CopyChannel& channel, std::size_t begin, std::size_t size) {
    channel.streams[0].copy(channel.chunk.data(), static_cast<const char*>(device) + begin, size);
    std::memcpy(static_cast<char*>(host) + begin, channel.chunk.data(), size);
  });
}

}  // namespace gale
