#pragma once

#include <algorithm>
#include <array>

#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// Follows the paths along `successors` (of each simplex, below 0 where a path ends) from start(0), ...,
/// start(count - 1), which aren't below 0. Calls ended(i, last, next) for each: the simplex that it ends at, and that
/// one's successor. Does so on all host threads; each has some paths under way at the same time, as a step is a wait
/// for memory.
template <class Start, class Ended>
void follow_each_path(const char* label, const Id* successors, Offset count, const Start& start, const Ended& ended) {
  struct Path {
    Offset which;
    Id at;
  };
  for_parts(label, count, threads_for(count), [&](int, Offset begin, Offset end) {
    std::array<Path, 16> paths;
    std::size_t under_way = 0;
    for (; under_way < paths.size() && begin < end; ++begin) paths[under_way++] = {begin, start(begin)};
    for (Offset steps = 0; under_way > 0;) {
      for (std::size_t k = 0; k < under_way;) {
        Path& path = paths[k];
        const Id next = successors[path.at];
        stop_if_asked_at(++steps);
        if (next >= 0) {
          path.at = next;
          __builtin_prefetch(successors + next);
          ++k;
          continue;
        }
        ended(path.which, path.at, next);
        if (begin < end) {
          path = {begin, start(begin)};
          ++begin;
        } else {
          path = paths[--under_way];
        }
      }
    }
  });
}

}  // namespace gale::detail
