#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/runtime/device/handed_stars.hpp>

namespace gale::detail {

template <class T>
KOKKOS_FORCEINLINE_FUNCTION void append(const DeviceList<T>& list, const T& item) {
  list.add(item);
}

/// Critical simplices as the lanes of kernels find them.
using LaneFound = const FoundSimplices<DeviceList>;

}  // namespace gale::detail
