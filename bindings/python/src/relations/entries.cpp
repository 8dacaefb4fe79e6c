#include "entries.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <gale/base/threads.hpp>

namespace gale::python {

namespace {

/// A hint: nothing depends on it. A page among many takes half of the time that it takes alone.
void expect_writes([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] int threads) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t piece = 1 << 16;
  const auto place = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (place + piece - 1) / piece, end = (place + bytes) / piece;
  if (end <= first) return;
  on_threads(threads, [&](int thread) {
    const auto begin_of = [&](int i) { return (first + (end - first) * i / threads) * piece; };
    const std::uintptr_t begin = begin_of(thread), length = begin_of(thread + 1) - begin;
    constexpr std::uintptr_t at_once = 16 * piece;
    for (std::uintptr_t done = 0; done < length; done += at_once) {
      detail::stop_if_asked();
      madvise(reinterpret_cast<void*>(begin + done), std::min(length - done, at_once), MADV_POPULATE_WRITE);
    }
  });
#endif
}

}  // namespace

Entries::Entries(std::size_t count, int threads) {
  resize(count);
  expect_writes(ids_, count * sizeof(Id), threads);
}

Entries::~Entries() { std::free(ids_); }

void Entries::resize(std::size_t count) {
  void* const ids = std::realloc(ids_, std::max<std::size_t>(count, 1) * sizeof(Id));
  if (ids == nullptr) throw std::bad_alloc();
  ids_ = static_cast<Id*>(ids);
}

std::shared_ptr<Id> Entries::release() { return {std::exchange(ids_, nullptr), std::free}; }

std::shared_ptr<std::int64_t[]> new_begins(std::size_t count, int threads) {
  std::shared_ptr<std::int64_t[]> begins(new std::int64_t[count]);
  expect_writes(begins.get(), count * sizeof(std::int64_t), threads);
  return begins;
}

}  // namespace gale::python
