#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include <gale/base/csr.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale {

/// Sorts `keys` ascending and carries `values` along; equal keys keep their order. Both arrays are overwritten.
/// O(n) a pass of 11 bits of the key, on a device of 8: those between the lowest and the highest bit in which some
/// keys differ. Uses as much memory again, on the host 8 bytes a key where these are 32 bits at most. Enqueued on the
/// instance of a device, but for looking for these bits, which waits.
template <class Space>
GALE_EXPORT void stable_sort_by_key(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& keys,
                                    const Array<Id, MemoryOf<Space>>& values);

/// Sorts `keys` ascending, and says where each stood; equal keys keep their order. As stable_sort_by_key, and faster
/// than that with values 0, 1, ...
template <class Space>
GALE_EXPORT Array<Id, MemoryOf<Space>> stable_sort_places(const Space& space, const std::string& label,
                                                          const Array<std::uint64_t, MemoryOf<Space>>& keys);

/// Sorts the entries of each row ascending, rows in parallel. Rows that are in order already cost one reading. `Index`
/// is Id or Offset. Enqueued on the instance of a device, as loops are.
template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Csr<Id, MemoryOf<Space>, Index>& rows);

namespace detail {

/// `less`, asking now and then whether to stop. One serves one thread.
template <class Less>
auto stoppable(const Less& less) {
  return [&less, calls = std::int64_t(0)](const auto& a, const auto& b) mutable {
    stop_if_asked_at(++calls);
    return less(a, b);
  };
}

}  // namespace detail

/// As std::sort, on the host's threads: each sorts a part, and then parts are merged two by two.
template <class Iterator, class Less = std::less<>>
void parallel_sort(const char* label, Iterator first, Iterator last, const Less& less = {}) {
  const Offset count = last - first;
  const int parts = detail::threads_for(count);
  const auto begin_of = [&](int part) { return first + detail::part_begin(count, parts, std::min(part, parts)); };
  detail::for_parts(label, count, parts, [&](int, Offset begin, Offset end) {
    auto is_before = detail::stoppable(less);
    std::sort(first + begin, first + end, std::ref(is_before));
  });
  for (int sorted = 1; sorted < parts; sorted *= 2) {
    on_threads((parts + 2 * sorted - 1) / (2 * sorted), [&](int pair) {
      const int begin = 2 * sorted * pair;
      auto is_before = detail::stoppable(less);
      std::inplace_merge(begin_of(begin), begin_of(begin + sorted), begin_of(begin + 2 * sorted), std::ref(is_before));
    });
  }
}

}  // namespace gale
