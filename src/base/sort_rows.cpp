#include <algorithm>

#include <gale/base/device.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>

namespace gale {

namespace {

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
    detail::sort_rows_on_device(space, label, begin, values);
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
