#pragma once

#include <cstddef>
#include <string>

#include <gale/base/memory.hpp>

namespace gale::detail {

/// Has the system give the pages of memory that will be written, many at a time, on so many threads: a page among many
/// takes half of the time that it takes alone. A hint: nothing depends on it.
GALE_EXPORT void expect_writes(void* data, std::size_t bytes, int threads);

/// Lets the system have back the pages of memory that nobody will read. A hint, too.
GALE_EXPORT void give_back(void* data, std::size_t bytes);

/// An array of the host's that will be written from end to end.
template <class T>
Array<T, HostMemory> array_to_write(const std::string& label, std::size_t count, int threads) {
  const auto array = allocate<Array<T, HostMemory>>(label, count);
  expect_writes(array.data(), count * sizeof(T), threads);
  return array;
}

}  // namespace gale::detail
