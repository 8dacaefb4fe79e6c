#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

/// Two runs that follow one another, each in order.
template <class Iterator>
struct TwoRuns {
  Iterator begin, middle, end;
};

/// Brings what comes first of both runs before all others: two runs of each, to be merged by themselves. Of equal
/// entries those of the first run stay first.
template <class Iterator, class Less>
void divide_runs(const TwoRuns<Iterator>& runs, const Less& less, TwoRuns<Iterator>* halves) {
  const auto [begin, middle, end] = runs;
  Iterator one = begin, other = middle;
  if (middle - begin > end - middle) {
    one += (middle - begin) / 2;
    other = std::lower_bound(middle, end, *one, less);
  } else if (middle != end) {
    other += (end - middle) / 2;
    one = std::upper_bound(begin, middle, *other, less);
  }
  const Iterator between = std::rotate(one, middle, other);
  halves[0] = {begin, one, between};
  halves[1] = {between, other, end};
}

}  // namespace detail

/// Merges runs that follow one another, each in order, two by two on the host's threads: run i is at begin[i] to
/// begin[i + 1], from `first` on. Of equal entries those of earlier runs stay first.
template <class Iterator, class Begin, class Less = std::less<>>
void merge_runs(Iterator first, const std::vector<Begin>& begin, const Less& less = {}) {
  using Runs = detail::TwoRuns<Iterator>;
  constexpr std::size_t worth_dividing = 16384;
  const int runs = static_cast<int>(begin.size()) - 1, threads = host_threads();
  const auto at = [&](int run) { return first + begin[std::min(run, runs)]; };
  for (int merged = 1; merged < runs; merged *= 2) {
    std::vector<Runs> pairs;
    for (int one = 0; one + merged < runs; one += 2 * merged)
      pairs.push_back({at(one), at(one + merged), at(one + 2 * merged)});
    const auto for_each_pair = [&](const auto& body) {
      in_turns(threads, static_cast<std::int64_t>(pairs.size()), [&](int, std::int64_t i) { body(i); });
    };
    const auto count = static_cast<std::size_t>(at(runs) - first);
    while (2 * pairs.size() <= static_cast<std::size_t>(threads) && count / pairs.size() > worth_dividing) {
      std::vector<Runs> halves(2 * pairs.size());
      for_each_pair([&](std::int64_t i) { detail::divide_runs(pairs[i], less, &halves[2 * i]); });
      pairs.swap(halves);
    }
    for_each_pair([&](std::int64_t i) {
      auto is_before = detail::stoppable(less);
      std::inplace_merge(pairs[i].begin, pairs[i].middle, pairs[i].end, std::ref(is_before));
    });
  }
}

/// As std::sort, on the host's threads: each sorts a part, and then parts are merged two by two.
template <class Iterator, class Less = std::less<>>
void parallel_sort(const char* label, Iterator first, Iterator last, const Less& less = {}) {
  const Offset count = last - first;
  const int parts = detail::threads_for(count);
  std::vector<Offset> begin_of;
  for (int part = 0; part <= parts; ++part) begin_of.push_back(detail::part_begin(count, parts, part));
  detail::for_parts(label, count, parts, [&](int, Offset begin, Offset end) {
    auto is_before = detail::stoppable(less);
    std::sort(first + begin, first + end, std::ref(is_before));
  });
  merge_runs(first, begin_of, less);
}

/// Sorts entries likewise, and keeps one of those that are equal.
template <class T, class Less = std::less<>>
void sort_distinct(const char* label, std::vector<T>& entries, const Less& less = {}) {
  parallel_sort(label, entries.begin(), entries.end(), less);
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace gale
