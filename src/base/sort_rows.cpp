#include <algorithm>

#include <gale/base/device.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort_rows.hpp>

namespace gale {

namespace {

template <class Index>
void sort_on_host(const char* label, const Csr<Id, HostMemory, Index>& rows) {
  parallel_for(label, HostExecutionSpace(), rows.rows(), [&](Offset i) {
    const Span<Id> row = rows.row(i);
    if (!std::is_sorted(row.begin(), row.end())) std::sort(row.begin(), row.end());
  });
}

}  // namespace

template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Csr<Id, MemoryOf<Space>, Index>& rows) {
  if (rows.rows() == 0 || rows.entries.extent(0) == 0) return;
  if constexpr (is_device<Space>) {
    detail::sort_rows_on_device(space, label, rows.offsets, rows.entries);
  } else {
    sort_on_host(label, rows);
  }
}

#define GALE_INSTANTIATE(Space)                                                            \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Id>&); \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Offset>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
