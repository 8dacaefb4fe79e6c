#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>

#if defined(KOKKOS_ENABLE_CUDA)
#include <cub/device/device_segmented_sort.cuh>

#include <gale/base/cub.hpp>
#endif

namespace gale {

template <class Index>
void sort_rows(const char* label, const Array<Index, WorkerMemory>& begin, const Array<Id, WorkerMemory>& values) {
  const auto rows = static_cast<Offset>(begin.extent(0)) - 1;
  if (rows < 1 || values.extent(0) == 0) return;
#if defined(KOKKOS_ENABLE_CUDA)
  const auto other = allocate<Array<Id, WorkerMemory>>("GALE::sort_rows", values.extent(0));
  cub::DoubleBuffer<Id> buffer(values.data(), other.data());
  detail::run_cub(label, [&](void* workspace, std::size_t& bytes, cudaStream_t stream) {
    return cub::DeviceSegmentedSort::SortKeys(workspace, bytes, buffer, static_cast<Offset>(values.extent(0)), rows,
                                              begin.data(), begin.data() + 1, stream);
  });
  if (buffer.Current() != values.data()) Kokkos::deep_copy(values, other);
#else
  parallel_for(label, WorkerSpace(), rows, [&](Offset row) {
    Id* const first = values.data() + begin(row);
    Id* const last = values.data() + begin(row + 1);
    if (!std::is_sorted(first, last)) std::sort(first, last);
  });
#endif
}

template void sort_rows(const char*, const Array<Id, WorkerMemory>&, const Array<Id, WorkerMemory>&);
template void sort_rows(const char*, const Array<Offset, WorkerMemory>&, const Array<Id, WorkerMemory>&);

}  // namespace gale
