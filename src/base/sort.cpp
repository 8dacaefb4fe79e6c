#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gale/base/device.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

namespace gale {

namespace {

using Keys = Array<std::uint64_t, HostMemory>;
using Values = Array<Id, HostMemory>;

constexpr int digit_bits = 11;
constexpr int digits = 1 << digit_bits;

using Histogram = std::array<Offset, digits>;

int digit_of(std::uint64_t key, int shift) { return static_cast<int>(key >> shift) & (digits - 1); }

/// Where each part of the input writes its first key of each digit. False if all keys have the same digit.
bool place_digits(const Keys& keys, int shift, std::vector<Histogram>& place) {
  const Offset n = keys.extent(0);
  detail::for_parts("GALE::sort_count", n, place.size(), [&](int part, Offset first, Offset last) {
    Histogram& mine = place[part];
    mine.fill(0);
    for (Offset i = first; i < last;) {
      for (const Offset end = detail::piece_end(i, last); i < end; ++i) ++mine[digit_of(keys(i), shift)];
    }
  });
  Offset sum = 0;
  for (int digit = 0; digit < digits; ++digit) {
    const Offset before = sum;
    for (auto& mine : place) sum += std::exchange(mine[digit], sum);
    if (sum - before == n) return false;
  }
  return true;
}

void sort_on_host(const Keys& keys, const Values& values) {
  const Offset n = keys.extent(0);
  Keys from_keys = keys, to_keys = allocate<Keys>("GALE::sort_keys", n);
  Values from_values = values, to_values = allocate<Values>("GALE::sort_values", n);
  std::vector<Histogram> place(detail::threads_for(n));
  for (int shift = 0; shift < 64; shift += digit_bits) {
    if (!place_digits(from_keys, shift, place)) continue;
    detail::for_parts("GALE::sort_move", n, place.size(), [&](int part, Offset first, Offset last) {
      for (Offset i = first; i < last;) {
        for (const Offset end = detail::piece_end(i, last); i < end; ++i) {
          const Offset to = place[part][digit_of(from_keys(i), shift)]++;
          to_keys(to) = from_keys(i);
          to_values(to) = from_values(i);
        }
      }
    });
    std::swap(from_keys, to_keys);
    std::swap(from_values, to_values);
  }
  if (from_keys.data() != keys.data()) {
    Kokkos::deep_copy(keys, from_keys);
    Kokkos::deep_copy(values, from_values);
  }
}

}  // namespace

template <class Space>
void stable_sort_by_key(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& keys,
                        const Array<Id, MemoryOf<Space>>& values) {
  if (keys.extent(0) < 2) return;
  if constexpr (is_device<Space>) {
    detail::sort_by_key_on_device(space, keys, values);
  } else {
    sort_on_host(keys, values);
  }
}

#define GALE_INSTANTIATE(Space)                                                                            \
  template GALE_EXPORT void stable_sort_by_key(const Space&, const Array<std::uint64_t, MemoryOf<Space>>&, \
                                               const Array<Id, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

namespace {

template <class Index>
void sort_rows_on_host(const char* label, const Csr<Id, HostMemory, Index>& rows) {
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
    sort_rows_on_host(label, rows);
  }
}

#define GALE_INSTANTIATE(Space)                                                            \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Id>&); \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Offset>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
