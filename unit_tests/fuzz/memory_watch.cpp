#include "fuzz/memory_watch.hpp"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
#define GALE_WATCHES_MEMORY 1
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef GALE_WATCHES_MEMORY
#endif
#endif
#endif

namespace gale::fuzz {

namespace {

std::atomic<bool> watching{false}, was_refused{false};
std::atomic<unsigned char> fill_byte{0};
std::atomic<long> now{0}, most{0}, allowed{0};

}  // namespace

#ifdef GALE_WATCHES_MEMORY

namespace {

bool may_have(std::size_t bytes) {
  if (!watching || (bytes < static_cast<std::size_t>(allowed) && now + static_cast<long>(bytes) <= allowed))
    return true;
  was_refused = true;
  errno = ENOMEM;
  return false;
}

/// Counts `data` and fills it from `begin` on.
void* added(void* data, std::size_t begin = 0) {
  if (data == nullptr || !watching) return data;
  const std::size_t bytes = malloc_usable_size(data);
  const long all = now += static_cast<long>(bytes);
  long before = most;
  while (before < all && !most.compare_exchange_weak(before, all)) {
  }
  if (begin < bytes) std::memset(static_cast<char*>(data) + begin, fill_byte, bytes - begin);
  return data;
}

void removed(void* data) {
  if (data != nullptr && watching) now -= static_cast<long>(malloc_usable_size(data));
}

}  // namespace

bool MemoryWatch::works() { return true; }

#else

bool MemoryWatch::works() { return false; }

#endif

MemoryWatch::MemoryWatch(unsigned char fill, std::size_t limit) {
  fill_byte = fill;
  allowed = static_cast<long>(limit);
  now = most = 0;
  was_refused = false;
  watching = true;
}

MemoryWatch::~MemoryWatch() { watching = false; }

std::size_t MemoryWatch::peak() { return static_cast<std::size_t>(most); }

bool MemoryWatch::refused() { return was_refused; }

}  // namespace gale::fuzz

#ifdef GALE_WATCHES_MEMORY

using gale::fuzz::added;
using gale::fuzz::may_have;
using gale::fuzz::removed;

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t bytes) { return may_have(bytes) ? added(__libc_malloc(bytes)) : nullptr; }

void* calloc(std::size_t count, std::size_t size) {
  if (size != 0 && count > static_cast<std::size_t>(-1) / 2 / size) return __libc_calloc(count, size);
  return may_have(count * size) ? added(__libc_calloc(count, size), static_cast<std::size_t>(-1)) : nullptr;
}

void* realloc(void* data, std::size_t bytes) {
  if (!may_have(bytes)) return nullptr;
  const std::size_t before = data == nullptr ? 0 : malloc_usable_size(data);
  removed(data);
  return added(__libc_realloc(data, bytes), before);
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  return may_have(bytes) ? added(__libc_memalign(alignment, bytes)) : nullptr;
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }

int posix_memalign(void** data, std::size_t alignment, std::size_t bytes) {
  void* const made = memalign(alignment, bytes);
  if (made == nullptr) return ENOMEM;
  *data = made;
  return 0;
}

void free(void* data) {
  removed(data);
  __libc_free(data);
}
}

#endif
