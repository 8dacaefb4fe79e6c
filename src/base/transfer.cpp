#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <deque>
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

/// A thread fills or empties one half of its pinned memory while the other travels. Halves fit a core's cache, so that
/// what is there costs no bandwidth of the host's memory.
constexpr std::size_t half_bytes = std::size_t(1) << 20;

/// One thread's way to the device and back, and the pinned memory that it goes through.
struct CopyChannel {
  struct Half {
    PinnedArray<char> memory;
    detail::CopyStream stream;
  };
  std::array<Half, 2> halves;

  /// Waits for all copies that have begun.
  void wait() const {
    for (const Half& half : halves) half.stream.wait();
  }
};

/// Bytes of an array.
struct Piece {
  std::size_t begin, size;
};

/// The channels of the process, which live until Kokkos is finalized: pinning memory takes longer than most copies. A
/// copy takes enough for some to fill or empty theirs while those of others travel, and leaves some for another one.
class CopyChannels {
 public:
  static CopyChannels& instance() {
    static CopyChannels channels;
    return channels;
  }

  /// Has there be channels for a copy on so many threads, and for another beside it.
  void prepare(int threads) {
    const std::lock_guard<std::mutex> lock(mutex_);
    add_channels(std::min(threads, most_of_one) + most_channels - most_of_one);
  }

  /// Calls work(channel, take) on some threads, each with a channel of its own; take() is the next piece of `bytes`
  /// bytes, of half a channel's memory at most, in the end one without bytes. Returns when all copies that these calls
  /// begin are done.
  template <class Work>
  void for_pieces(std::size_t bytes, const Work& work) {
    const std::size_t pieces = (bytes + half_bytes - 1) / half_bytes;
    if (pieces == 0) return;
    const TakenChannels taken(*this, static_cast<int>(std::min<std::size_t>(pieces, host_threads())));
    std::atomic<std::size_t> next{0};
    const auto take = [&]() -> Piece {
      detail::stop_if_asked();
      const std::size_t piece = next++;
      if (piece >= pieces) return {bytes, 0};
      return {piece * half_bytes, std::min(half_bytes, bytes - piece * half_bytes)};
    };
    on_threads(static_cast<int>(taken.channels.size()), [&](int thread) {
      const CopyChannel& channel = *taken.channels[thread];
      try {
        work(channel, take);
      } catch (...) {
        channel.wait();  // the caller may free what they write to
        throw;
      }
      channel.wait();
    });
  }

 private:
  static constexpr int most_of_one = 16, most_channels = 20;

  /// Channels of one copy: as many as it wants, or as are left.
  struct TakenChannels {
    TakenChannels(CopyChannels& from, int wanted) : all(from) {
      wanted = std::min(wanted, most_of_one);
      std::unique_lock<std::mutex> lock(all.mutex_);
      try {
        all.add_channels(static_cast<int>(all.channels_.size() - all.free_.size()) + wanted);
      } catch (const Error&) {
        if (all.channels_.empty()) throw;
      }
      all.changed_.wait(lock, [&] { return !all.free_.empty(); });
      const auto first = all.free_.end() - std::min<std::ptrdiff_t>(wanted, std::ptrdiff_t(all.free_.size()));
      channels.assign(first, all.free_.end());
      all.free_.erase(first, all.free_.end());
    }
    ~TakenChannels() {
      const std::lock_guard<std::mutex> lock(all.mutex_);
      all.free_.insert(all.free_.end(), channels.begin(), channels.end());
      all.changed_.notify_all();
    }
    TakenChannels(const TakenChannels&) = delete;
    TakenChannels& operator=(const TakenChannels&) = delete;

    CopyChannels& all;  ///< where they go back to
    std::vector<const CopyChannel*> channels;
  };

  /// Has there be so many, as far as there may be. New ones take their memory from one array: pinning costs more by the
  /// call than by the byte.
  void add_channels(int count) {
    const int missing = std::min(count, most_channels) - static_cast<int>(channels_.size());
    if (missing <= 0) return;
    use_device();
    free_.reserve(most_channels);
    if (channels_.empty()) {
      detail::call_at_end([this] {
        free_.clear();
        channels_.clear();
      });
    }
    const PinnedArray<char> memory(static_cast<std::size_t>(missing) * 2 * half_bytes);
    const auto half = [&](int i) { return CopyChannel::Half{memory.slice(i * half_bytes, half_bytes), {}}; };
    for (int i = 0; i < missing; ++i) {
      channels_.push_back({{half(2 * i), half(2 * i + 1)}});
      free_.push_back(&channels_.back());
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<CopyChannel> channels_;
  std::vector<const CopyChannel*> free_;
};

/// Copies from the device what is there.
void copy_pieces(void* host, const void* device, std::size_t bytes) {
  CopyChannels::instance().for_pieces(bytes, [&](const CopyChannel& channel, const auto& take) {
    const auto begin = [&](int i, const Piece& piece) {
      const auto& [memory, stream] = channel.halves[i];
      if (piece.size > 0) stream.begin_copy(memory.data(), static_cast<const char*>(device) + piece.begin, piece.size);
    };
    Piece piece = take();
    begin(0, piece);
    for (int i = 0; piece.size > 0; i ^= 1) {
      const Piece next = take();
      begin(i ^ 1, next);
      channel.halves[i].stream.wait();
      std::memcpy(static_cast<char*>(host) + piece.begin, channel.halves[i].memory.data(), piece.size);
      piece = next;
    }
  });
}

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
  CopyChannels::instance().for_pieces(bytes, [&](const CopyChannel& channel, const auto& take) {
    int i = 0;
    for (Piece piece = take(); piece.size > 0; piece = take(), i ^= 1) {
      const auto& [memory, stream] = channel.halves[i];
      stream.wait();
      write(memory.data(), piece.begin, piece.size);
      stream.begin_copy(static_cast<char*>(device) + piece.begin, memory.data(), piece.size);
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
  copy_pieces(host, device, bytes);
}

void detail::copy_meanwhile(void* host, const void* device, std::size_t bytes) {
  constexpr int few = 4;
  const ThreadLimit limit(few);
  copy_pieces(host, device, bytes);
}

}  // namespace gale
