#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include <gale/base/mirrored.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// Where paths end, on the host.
struct PathStops {
  Array<Id, HostMemory> last;  ///< the simplex that each ends at
  Array<Id, HostMemory> next;  ///< that one's successor, below 0
};

/// Follows one path.
template <class Memory>
struct FollowPath {
  Array<const Id, Memory> successors, starts;
  Array<Id, Memory> last, next;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    Id at = starts(i), to = successors(at);
    for (; to >= 0; to = successors(at)) at = to;
    last(i) = at;
    next(i) = to;
  }
};

/// Follows each of some paths to its end where `successors` lie, in the memory of `space`: a thread for each.
template <class Space>
PathStops follow_in(const Space& space, const char* label, const Array<const Id, MemoryOf<Space>>& successors,
                    const Array<Id, HostMemory>& starts) {
  using Memory = MemoryOf<Space>;
  const Momentary<const Id, Memory> from("GALE::path_starts", starts);
  const Momentary<Id, Memory> last("GALE::path_ends", starts.extent(0));
  const Momentary<Id, Memory> next("GALE::behind_path_ends", starts.extent(0));
  parallel_for(label, space, starts.extent(0),
               FollowPath<Memory>{successors, from.array(), last.array(), next.array()});
  space.fence();
  return {on_host(last.array()), on_host(next.array())};
}

/// Counts the simplices of paths. Those that leave through the surface may have none.
template <class Successors, class Memory>
struct CountOnPath {
  Successors successors;
  Array<const Id, Memory> starts;
  bool with_leaving;
  Array<Offset, Memory> begin;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    Offset length = 1;
    Id next = successors[starts(i)];
    for (; next >= 0; next = successors[next]) ++length;
    begin(i) = next == no_id || with_leaving ? length : 0;
  }
};

/// Writes the simplices of paths, one path after the other.
template <class Successors, class Memory>
struct WritePath {
  Successors successors;
  Array<const Id, Memory> starts;
  Array<Offset, Memory> begin;
  Array<Id, Memory> simplices;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    if (begin(i + 1) == begin(i)) return;
    Id simplex = starts(i);
    for (Offset at = begin(i); at < begin(i + 1); ++at, simplex = successors[simplex]) simplices(at) = simplex;
  }
};

/// The simplices of paths, those of the i-th from begin(i) on.
template <class Memory>
struct PathsFromStarts {
  Array<Offset, Memory> begin;
  Array<Id, Memory> simplices;
};

/// Follows the paths of `successors` from some simplices, in the memory of `space`: a thread for each. Those that leave
/// through the surface are empty, unless `with_leaving`.
template <class Space, class Successors>
PathsFromStarts<MemoryOf<Space>> follow_whole(const Space& space, const Successors& successors,
                                              const std::vector<Id>& starts, bool with_leaving) {
  using Memory = MemoryOf<Space>;
  const Offset count = static_cast<Offset>(starts.size());
  const Momentary<const Id, Memory> of("GALE::path_starts", Array<const Id, HostMemory>(starts.data(), starts.size()));
  const Array<const Id, Memory>& from = of.array();
  const auto begin = allocate<Array<Offset, Memory>>("GALE::path_begin", count + 1);
  parallel_for("GALE::path_lengths", space, count,
               CountOnPath<Successors, Memory>{successors, from, with_leaving, begin});
  const Offset total = exclusive_scan("GALE::path_begins", space, count, begin, begin);
  const auto simplices = allocate<Array<Id, Memory>>("GALE::path_simplices", total);
  parallel_for("GALE::follow_paths", space, count, WritePath<Successors, Memory>{successors, from, begin, simplices});
  space.fence();
  return {begin, simplices};
}

/// Brings a successor that is soon read near.
inline void bring_near(const Id* successors, Id simplex) { __builtin_prefetch(successors + simplex); }

/// Walks along the paths of `successors` (of each simplex, below 0 where a path ends) from start(0), ...,
/// start(count - 1), which aren't below 0, on all host threads. Calls pass(i, k, simplex) for the k-th simplex of each,
/// from 0 on, and ended(i, length, last, next) when it has passed the last one, whose successor is `next`. A thread has
/// some paths under way at the same time, as a step is a wait for memory.
template <class Successors, class Start, class Pass, class Ended>
void walk_each_on_host(const char* label, const Successors& successors, Offset count, const Start& start,
                       const Pass& pass, const Ended& ended) {
  struct Path {
    Offset which, passed;
    Id at;
  };
  for_parts(label, count, threads_for(count), [&](int, Offset begin, Offset end) {
    std::array<Path, 16> paths;
    std::size_t under_way = 0;
    const auto set_out = [&](Path& path) {
      path = {begin, 1, start(begin)};
      bring_near(successors, path.at);
      pass(begin++, Offset(0), path.at);
    };
    while (under_way < paths.size() && begin < end) set_out(paths[under_way++]);
    for (Offset steps = 0; under_way > 0;) {
      for (std::size_t k = 0; k < under_way;) {
        Path& path = paths[k];
        const Id next = successors[path.at];
        stop_if_asked_at(++steps);
        if (next >= 0) {
          path.at = next;
          bring_near(successors, next);
          pass(path.which, path.passed++, next);
          ++k;
          continue;
        }
        ended(path.which, path.passed, path.at, next);
        if (begin < end) {
          set_out(path);
          ++k;
        } else {
          path = paths[--under_way];
        }
      }
    }
  });
}

/// Follows paths to their ends, as walk_each_on_host does: calls ended(i, last, next) for each.
template <class Start, class Ended>
void follow_each_on_host(const char* label, const Id* successors, Offset count, const Start& start,
                         const Ended& ended) {
  walk_each_on_host(
      label, successors, count, start, [](Offset, Offset, Id) {},
      [&](Offset i, Offset, Id last, Id next) { ended(i, last, next); });
}

/// Follows paths as follow_each_on_host where the successors were made: on a device, unless that lacks the memory, or
/// on the host. Calls `ended` on host threads.
template <class Start, class Ended>
void follow_each_path(const char* label, const Mirrored<Id>& successors, Offset count, const Start& start,
                      const Ended& ended) {
  in_worker_or_host_space(successors.on_device(), [&](const auto& space) {
    using Space = std::decay_t<decltype(space)>;
    if constexpr (is_device<Space>) {
      const auto starts = allocate<Array<Id, HostMemory>>("GALE::path_starts", count);
      parallel_for(label, HostExecutionSpace(), count, [&](Offset i) { starts(i) = start(i); });
      const PathStops stops = follow_in(space, label, successors.in<MemoryOf<Space>>(), starts);
      parallel_for(label, HostExecutionSpace(), count, [&](Offset i) { ended(i, stops.last(i), stops.next(i)); });
    } else {
      follow_each_on_host(label, successors.in<HostMemory>().data(), count, start, ended);
    }
  });
}

}  // namespace gale::detail
