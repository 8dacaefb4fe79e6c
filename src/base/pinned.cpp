#include <gale/base/pinned.hpp>

#include <new>

#if defined(KOKKOS_ENABLE_CUDA)

#include <cuda_runtime_api.h>
#include <sys/mman.h>

#include <gale/base/memory.hpp>

namespace gale::detail {

std::shared_ptr<void> allocate_pinned_bytes(std::size_t bytes) {
  constexpr std::size_t page = 4096;
  const std::size_t size = (bytes + page) / page * page;
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  advise_huge_pages(memory, size);
  for (std::size_t at = 0; at < size; at += page) static_cast<volatile char*>(memory)[at] = 0;
  if (cudaHostRegister(memory, size, cudaHostRegisterDefault) != cudaSuccess) {
    cudaGetLastError();
    munmap(memory, size);
    throw std::bad_alloc();
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
  return {::operator new(bytes), [](void* at) { ::operator delete(at); }};
}

}  // namespace gale::detail

#endif
