// The calls that can be made to fail.
#include "shim.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace gale::faults {

namespace {

Fault nothing;

/// The function that this library hides.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Reading isn't what fails here, nor is saying what failed.
bool is_output(int file) {
  struct stat status {};
  return file > 2 && fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
         (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

bool file_fails() {
  if (!fails(Kind::file)) return false;
  errno = fault->error;
  return true;
}

void* no_memory() {
  errno = ENOMEM;
  return nullptr;
}

}  // namespace

Fault* fault = &nothing;

bool fails(Kind kind) {
  if (!fault->counts.load(std::memory_order_relaxed) || fault->kind != kind) return false;
  const long call = ++fault->calls;
  if (call < fault->at || call > fault->at + fault->more) return false;
  ++fault->failed;
  return true;
}

}  // namespace gale::faults

using gale::faults::fails;
using gale::faults::file_fails;
using gale::faults::is_output;
using gale::faults::Kind;
using gale::faults::next;

extern "C" {

// glibc's own names for what is hidden here: dlsym itself allocates.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) noexcept {
  return fails(Kind::allocation) ? gale::faults::no_memory() : __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  return fails(Kind::allocation) ? gale::faults::no_memory() : __libc_calloc(count, size);
}

void* realloc(void* data, std::size_t bytes) noexcept {
  return fails(Kind::allocation) ? gale::faults::no_memory() : __libc_realloc(data, bytes);
}

void* memalign(std::size_t alignment, std::size_t bytes) noexcept {
  return fails(Kind::allocation) ? gale::faults::no_memory() : __libc_memalign(alignment, bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept { return memalign(alignment, bytes); }

int posix_memalign(void** data, std::size_t alignment, std::size_t bytes) noexcept {
  void* const made = memalign(alignment, bytes);
  if (made == nullptr) return ENOMEM;
  *data = made;
  return 0;
}

ssize_t write(int file, const void* data, std::size_t bytes) {
  static auto* const real = next<decltype(write)>("write");
  return is_output(file) && file_fails() ? -1 : real(file, data, bytes);
}

ssize_t pwrite(int file, const void* data, std::size_t bytes, off_t at) {
  static auto* const real = next<decltype(pwrite)>("pwrite");
  return is_output(file) && file_fails() ? -1 : real(file, data, bytes, at);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  static auto* const real = next<decltype(writev)>("writev");
  return is_output(file) && file_fails() ? -1 : real(file, parts, count);
}

std::size_t fwrite(const void* data, std::size_t size, std::size_t count, FILE* file) {
  static auto* const real = next<decltype(fwrite)>("fwrite");
  return is_output(fileno(file)) && file_fails() ? 0 : real(data, size, count, file);
}

int fsync(int file) {
  static auto* const real = next<decltype(fsync)>("fsync");
  return file_fails() ? -1 : real(file);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const real = next<decltype(rename)>("rename");
  return file_fails() ? -1 : real(from, to);
}

int link(const char* from, const char* to) noexcept {
  static auto* const real = next<decltype(link)>("link");
  return file_fails() ? -1 : real(from, to);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  static auto* const real = next<decltype(linkat)>("linkat");
  return file_fails() ? -1 : real(from_folder, from, to_folder, to, flags);
}

/// Like the system's, it closes the file whatever it says.
int close(int file) {
  static auto* const real = next<decltype(close)>("close");
  const bool fault = is_output(file) && file_fails();
  const int result = real(file);
  if (!fault) return result;
  errno = gale::faults::fault->error;
  return -1;
}

int fclose(FILE* file) {
  static auto* const real = next<decltype(fclose)>("fclose");
  const bool fault = is_output(fileno(file)) && file_fails();
  const int result = real(file);
  if (!fault) return result;
  errno = gale::faults::fault->error;
  return EOF;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) {
  static auto* const real = next<decltype(pthread_create)>("pthread_create");
  return fails(Kind::thread) ? EAGAIN : real(thread, attributes, body, argument);
}
}
