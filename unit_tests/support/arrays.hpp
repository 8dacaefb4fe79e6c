#pragma once

#include <vector>

#include <gale/base/mirrored.hpp>
#include <gale/base/transfer.hpp>

namespace gale::test {

/// A view of a vector, which must live as long.
template <class T>
Array<const T, HostMemory> view_of(const std::vector<T>& values) {
  return Array<const T, HostMemory>(values.data(), values.size());
}

template <class T>
Array<T, WorkerMemory> to_worker(const std::vector<T>& values) {
  const Array<T, WorkerMemory> array(Kokkos::view_alloc("test", Kokkos::WithoutInitializing), values.size());
  Kokkos::deep_copy(array, Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>(values.data(), values.size()));
  return array;
}

template <class T, class Memory>
std::vector<std::remove_const_t<T>> to_vector(const Kokkos::View<T*, Memory>& array) {
  const auto host = on_host(array);
  return {host.data(), host.data() + host.extent(0)};
}

template <class T>
std::vector<T> to_vector(const Mirrored<T>& array) {
  return to_vector(array.template in<HostMemory>());
}

}  // namespace gale::test
