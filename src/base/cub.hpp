#pragma once

// CUB's device-wide algorithms, called the way they all want to be: once for the size of their workspace, once for the
// work. Only for translation units of a CUDA build.

#include <string>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// `algorithm(workspace, bytes, stream)` calls one of CUB's. It is enqueued on the instance; giving its workspace back
/// waits for it, as the device's memory is freed. Throws gale::Error if it fails.
template <class Algorithm>
void run_cub(const WorkerSpace& space, const char* label, const Algorithm& algorithm) {
  const auto check = [label](cudaError_t status) {
    if (status != cudaSuccess) throw Error(std::string(label) + " failed on the device: " + cudaGetErrorString(status));
  };
  std::size_t bytes = 0;
  check(algorithm(nullptr, bytes, space.cuda_stream()));
  const auto workspace = allocate<Array<char, WorkerMemory>>(label, bytes);
  check(algorithm(workspace.data(), bytes, space.cuda_stream()));
}

}  // namespace gale::detail
