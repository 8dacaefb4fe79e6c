#include <new>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/pinned.hpp>

#if defined(KOKKOS_ENABLE_CUDA)

#include <cuda_runtime_api.h>
#include <sys/mman.h>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

namespace {

constexpr std::size_t page = 4096;

/// Has the system give all pages, by one thread or, where there are many, by all.
void touch(void* memory, std::size_t size) {
  constexpr std::size_t many = std::size_t(16) << 20;
  volatile char* const bytes = static_cast<volatile char*>(memory);
  const auto touch_page = [bytes](Offset i) { bytes[static_cast<std::size_t>(i) * page] = 0; };
  const auto pages = static_cast<Offset>(size / page);
  if (size >= many) {
    parallel_for("GALE::touch_pinned", Kokkos::DefaultHostExecutionSpace(), pages, touch_page);
  } else {
    for (Offset i = 0; i < pages; ++i) touch_page(i);
  }
}

}  // namespace

std::shared_ptr<void> allocate_pinned_bytes(std::size_t bytes) {
  const std::size_t size = (bytes + page) / page * page;
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const auto refuse = [size] {
    throw OutOfMemory("the host has no " + std::to_string(size) + " bytes of page-locked memory");
  };
  if (memory == MAP_FAILED) refuse();
  advise_huge_pages(memory, size);
  touch(memory, size);
  use_device();
  if (cudaHostRegister(memory, size, cudaHostRegisterDefault) != cudaSuccess) {
    cudaGetLastError();
    munmap(memory, size);
    refuse();
  }
  return {memory, [size](void* at) {
            cudaHostUnregister(at);
            munmap(at, size);
          }};
}

}  // namespace gale::detail

#else

namespace gale::detail {

std::shared_ptr<void> allocate_pinned_bytes(std::size_t bytes) {
  try {
    return {::operator new(bytes), [](void* at) { ::operator delete(at); }};
  } catch (const std::bad_alloc&) {
    throw OutOfMemory("the host has no " + std::to_string(bytes) + " bytes for a batch");
  }
}

}  // namespace gale::detail

#endif
