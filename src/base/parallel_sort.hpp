#pragma once

#include <algorithm>
#include <functional>

#include <gale/base/parallel.hpp>

namespace gale {

/// As std::sort, on the host's threads: each sorts a part, and then parts are merged two by two.
template <class Iterator, class Less = std::less<>>
void parallel_sort(const char* label, Iterator first, Iterator last, const Less& less = {}) {
  const Offset count = last - first;
  const int parts = detail::threads_for(count);
  const auto begin_of = [&](int part) { return first + detail::part_begin(count, parts, std::min(part, parts)); };
  detail::for_parts(label, count, parts,
                    [&](int, Offset begin, Offset end) { std::sort(first + begin, first + end, less); });
  for (int sorted = 1; sorted < parts; sorted *= 2) {
    on_threads((parts + 2 * sorted - 1) / (2 * sorted), [&](int pair) {
      const int begin = 2 * sorted * pair;
      std::inplace_merge(begin_of(begin), begin_of(begin + sorted), begin_of(begin + 2 * sorted), less);
    });
  }
}

}  // namespace gale
