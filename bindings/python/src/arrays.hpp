#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <string>
#include <vector>

#include <Kokkos_Core.hpp>

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>

// Arrays that callers hand over, by DLPack or as numpy's, in host memory or a device's.

namespace gale::python {

namespace nb = nanobind;

/// Read where it is. Its rows follow each other.
using Array1 = nb::ndarray<nb::ro, nb::c_contig>;

template <class T>
bool is(const Array1& array) {
  return array.dtype() == nb::dtype<T>();
}

/// Throws gale::Error, calling the array `name`, unless it has the shape (n, width).
void require_rows(const Array1& array, std::size_t width, const char* name);

/// Whether the array is in a device's memory. Throws gale::Error, calling the array `name`, if this build of GALE can't
/// read it there. Waits for what others do on the device, so that what they write is there.
bool is_on_device(const Array1& array, const char* name);

/// What has `__cuda_array_interface__`, but not DLPack, as DLPack has it. `type` is a code of numpy's: 'f', 'i' or 'u'.
nb::ndarray<> device_array(std::uintptr_t data, const std::vector<std::size_t>& shape, char type, int bytes,
                           const nb::object& owner);

/// What `use` returns for a View of the array's rows, or of its values where there is no width: `Element` is e.g.
/// const float*[3]. In the memory where the array is.
template <class Element, class Use>
auto with_view(const Array1& array, const char* name, const Use& use) {
  using InHost = Kokkos::View<Element, Kokkos::LayoutRight, HostMemory>;
  using InWorker = Kokkos::View<Element, Kokkos::LayoutRight, WorkerMemory>;
  const auto* const data = static_cast<typename InHost::const_value_type*>(array.data());
  if (is_on_device(array, name)) return use(InWorker(data, array.shape(0)));
  return use(InHost(data, array.shape(0)));
}

}  // namespace gale::python
