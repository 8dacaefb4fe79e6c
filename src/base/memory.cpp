#include <algorithm>
#include <cstdint>
#include <mutex>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <gale/base/memory.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

/// Pages may be as large as this.
constexpr std::uintptr_t page_group = 1 << 16;

}  // namespace

void advise_huge_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = 4096;
  constexpr std::size_t large = std::size_t(4) << 20;
  if (bytes < large) return;
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

void expect_writes([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] int threads) {
#ifdef MADV_POPULATE_WRITE
  const auto place = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (place + page_group - 1) / page_group, end = (place + bytes) / page_group;
  if (end <= first) return;
  on_threads(threads, [&](int thread) {
    const auto begin_of = [&](int i) { return (first + (end - first) * i / threads) * page_group; };
    const std::uintptr_t begin = begin_of(thread), length = begin_of(thread + 1) - begin;
    constexpr std::uintptr_t at_once = 16 * page_group;
    for (std::uintptr_t done = 0; done < length; done += at_once) {
      stop_if_asked();
      madvise(reinterpret_cast<void*>(begin + done), std::min(length - done, at_once), MADV_POPULATE_WRITE);
    }
  });
#endif
}

void give_back([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_DONTNEED
  const auto place = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (place + page_group - 1) / page_group, end = (place + bytes) / page_group;
  if (end > first) madvise(reinterpret_cast<void*>(first * page_group), (end - first) * page_group, MADV_DONTNEED);
#endif
}

void call_at_end(std::function<void()> end) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  Kokkos::push_finalize_hook(std::move(end));
}

}  // namespace gale::detail
