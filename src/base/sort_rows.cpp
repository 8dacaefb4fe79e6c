#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>

#if defined(KOKKOS_ENABLE_CUDA)
#include <cub/device/device_segmented_sort.cuh>

#include <gale/base/cub.hpp>
#endif

namespace gale {

namespace {

#if defined(KOKKOS_ENABLE_CUDA)
template <class Index>
void sort_on_device(const WorkerSpace& space, const char* label, const Array<Index, WorkerMemory>& begin,
                    const Array<Id, WorkerMemory>& values) {
  const auto rows = static_cast<Offset>(begin.extent(0)) - 1;
  const auto other = allocate<Array<Id, WorkerMemory>>("GALE::sort_rows", values.extent(0));
  cub::DoubleBuffer<Id> buffer(values.data(), other.data());
  detail::run_cub(space, label, [&](void* workspace, std::size_t& bytes, cudaStream_t stream) {
    return cub::DeviceSegmentedSort::SortKeys(workspace, bytes, buffer, static_cast<Offset>(values.extent(0)), rows,
                                              begin.data(), begin.data() + 1, stream);
  });
  if (buffer.Current() != values.data()) Kokkos::deep_copy(space, values, other);
}
#endif

template <class Index>
void sort_on_host(const char* label, const Array<Index, HostMemory>& begin, const Array<Id, HostMemory>& values) {
  parallel_for(label, HostExecutionSpace(), begin.extent(0) - 1, [&](Offset row) {
    Id* const first = values.data() + begin(row);
    Id* const last = values.data() + begin(row + 1);
    if (!std::is_sorted(first, last)) std::sort(first, last);
  });
}

}  // namespace

template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Array<Index, MemoryOf<Space>>& begin,
               const Array<Id, MemoryOf<Space>>& values) {
  if (begin.extent(0) < 2 || values.extent(0) == 0) return;
  if constexpr (is_device<Space>) {
    sort_on_device(space, label, begin, values);
  } else {
    sort_on_host(label, begin, values);
  }
}

#define GALE_INSTANTIATE(Space)                                                             \
  template void sort_rows(const Space&, const char*, const Array<Id, MemoryOf<Space>>&,     \
                          const Array<Id, MemoryOf<Space>>&);                               \
  template void sort_rows(const Space&, const char*, const Array<Offset, MemoryOf<Space>>&, \
                          const Array<Id, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
