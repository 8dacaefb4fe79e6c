#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/base/kokkos.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/team.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/types.hpp>

// Loops over 0..n-1 in an execution space. On a device they are Kokkos' own. On the host they run on our threads,
// whatever backend Kokkos has there: Kokkos::Serial is one core, our users have more.
//
// On a device a loop is enqueued on the instance of the space that it is given and doesn't wait for it, as Kokkos' own;
// what returns a value waits for that. So whoever hands data to the host or to another instance fences first. On the
// host every loop is done when it returns. All throw gale::Error if Kokkos isn't initialized.
//
// On the host a loop throws Stopped soon after it is asked to (gale/base/stop.hpp).
//
// A loop in a header that may run on the host takes a functor with a name, no KOKKOS_LAMBDA: nvcc has the host call
// that one through a pointer, which was null where several sources had the same loop.

namespace gale {

namespace detail {

/// The i-th of `count` nearly equal parts of 0..n-1 begins here.
inline Offset part_begin(Offset n, int count, int i) { return n * i / count; }

/// How many threads a loop over 0..n-1 is worth: one, where that is done before others wake, else all that have a part
/// worth the while.
inline int threads_for(Offset n) {
  constexpr Offset worth_waking = 2048, worth_a_thread = 512;
  return n < worth_waking ? 1 : static_cast<int>(std::min<Offset>(n / worth_a_thread, host_threads()));
}

template <class Body>
void for_parts(const char* label, Offset n, int parts, const Body& body) {
  require_kokkos();
  const ToolsRegion region(label);
  on_threads(parts, [&](int part) { body(part, part_begin(n, parts, part), part_begin(n, parts, part + 1)); });
}

/// Calls `body(i)` for i from `first` to last-1, in order, and asks now and then whether to stop. Always inlined, so
/// that what the body counts in stays in registers.
template <class Body>
__attribute__((always_inline)) inline void for_range(Offset first, Offset last, const Body& body) {
  constexpr Offset at_once = 1024;
  for (Offset i = first; i < last;) {
    stop_if_asked();
    for (const Offset end = std::min(i + at_once, last); i < end; ++i) body(i);
  }
}

/// What f(begin, end) returns of each of the nearly equal parts of 0..n-1 that host threads take, in that order.
template <class F>
auto of_parts(const char* label, Offset n, const F& f) {
  using Result = std::decay_t<decltype(f(n, n))>;
  static_assert(!std::is_same_v<Result, bool>, "threads can't write bits side by side");
  std::vector<Result> all(threads_for(n));
  for_parts(label, n, static_cast<int>(all.size()),
            [&](int part, Offset begin, Offset end) { all[part] = f(begin, end); });
  return all;
}

/// Turns counts into places: parts[i][key] is how many members part i has of a key, and becomes the place of the first
/// of them. Returns where each key begins, and the end of the last.
template <class Index, class Counts>
std::vector<Index> begins_of_parts(std::vector<Counts>& parts, Offset keys) {
  std::vector<Index> begin(1, 0);
  begin.reserve(keys + 1);
  Index at = 0;
  for (Offset key = 0; key < keys; ++key) {
    for (Counts& counts : parts) at += std::exchange(counts[key], at);
    begin.push_back(at);
  }
  return begin;
}

/// Entries of all parts, one part after the other; there is at least one part.
template <class T>
std::vector<T> concatenated(std::vector<std::vector<T>> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  std::vector<T> all;
  reserve(all, std::accumulate(parts.begin(), parts.end(), std::size_t(0),
                               [](std::size_t sum, const std::vector<T>& part) { return sum + part.size(); }));
  for (const std::vector<T>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// 0..n-1 on a device, for a loop that is enqueued at once, whatever is under way on this instance or others.
template <class Space>
auto device_range(const Space& space, Offset n) {
  return overlapping(Kokkos::RangePolicy<Space, Kokkos::IndexType<Offset>>(space, 0, n));
}

}  // namespace detail

/// Calls `body(i)` for every i in 0..n-1, in parallel and in no order. On a device it returns at once.
template <class Space, class Body>
void parallel_for(const char* label, const Space& space, Offset n, const Body& body) {
  require_kokkos();
  if constexpr (is_device<Space>) {
    Kokkos::parallel_for(label, detail::device_range(space, n), body);
  } else {
    detail::for_parts(label, n, detail::threads_for(n),
                      [&](int, Offset begin, Offset end) { detail::for_range(begin, end, body); });
  }
}

namespace detail {

/// An array of the host's whose i-th entry is value(i).
template <class T, class Value>
Array<T, HostMemory> tabulated(const char* label, Offset count, const Value& value) {
  const auto all = allocate<Array<T, HostMemory>>(label, count);
  parallel_for(label, HostExecutionSpace(), count, [&](Offset i) { all(i) = value(i); });
  return all;
}

/// An array of the host's that has these entries.
template <class T>
Array<T, HostMemory> array_of(const std::string& label, const std::vector<T>& entries) {
  const auto all = allocate<Array<T, HostMemory>>(label, entries.size());
  std::copy(entries.begin(), entries.end(), all.data());
  return all;
}

/// Makes room for so many entries, to be written from end to end, in memory that the system gives on all host
/// threads: where nobody wrote before, that takes longer than to write them.
template <class T>
std::vector<T> unwritten(std::size_t count) {
  return UnwrittenVector<T>(count, threads_for(static_cast<Offset>(count)));
}

/// Makes so many zeros, likewise.
template <class T>
std::vector<T> zeros(std::size_t count) {
  auto all = unwritten<T>(count);
  for_parts("GALE::zeros", static_cast<Offset>(count), threads_for(static_cast<Offset>(count)),
            [&](int, Offset begin, Offset end) { std::uninitialized_fill(all.data() + begin, all.data() + end, T()); });
  return all;
}

/// Writes its place, or the same value, to each entry.
template <class Ids>
struct WritePlace {
  Ids ids;
  KOKKOS_FUNCTION void operator()(Offset i) const { ids(i) = static_cast<Id>(i); }
};
template <class View>
struct WriteValue {
  View view;
  typename View::non_const_value_type value;
  KOKKOS_FUNCTION void operator()(Offset i) const { view(i) = value; }
};

}  // namespace detail

/// Gives all entries of an array of rank 1 the same value.
template <class Space, class View>
void fill(const char* label, const Space& space, const View& view, typename View::non_const_value_type value) {
  parallel_for(label, space, static_cast<Offset>(view.extent(0)), detail::WriteValue<View>{view, value});
}

/// 0, 1, ..., count - 1.
template <class Space>
Array<Id, MemoryOf<Space>> iota(const std::string& label, const Space& space, Offset count) {
  const auto ids = allocate<Array<Id, MemoryOf<Space>>>(label, count);
  parallel_for("GALE::iota", space, count, detail::WritePlace<Array<Id, MemoryOf<Space>>>{ids});
  return ids;
}

/// begin[i] = count(0) + ... + count(i-1) for i in 0..n; returns begin[n], for which it waits. `count(i)` may read
/// begin[i], and may be `begin`.
template <class Space, class T, class Count>
T exclusive_scan(const char* label, const Space& space, Offset n, const Array<T, typename Space::memory_space>& begin,
                 const Count& count) {
  if constexpr (is_device<Space>) {
    T total = 0;
    Kokkos::parallel_scan(
        label, detail::device_range(space, n + 1),
        KOKKOS_LAMBDA(Offset i, T & sum, bool final) {
          const T here = i < n ? static_cast<T>(count(i)) : T(0);
          if (final) begin(i) = sum;
          sum += here;
        },
        total);
    return total;
  } else {
    std::vector<T> before = detail::of_parts(label, n, [&](Offset first, Offset last) {
      T sum = 0;
      detail::for_range(first, last, [&](Offset i) { sum += static_cast<T>(count(i)); });
      return sum;
    });
    T total = 0;
    for (T& part : before) total += std::exchange(part, total);
    detail::for_parts(label, n, static_cast<int>(before.size()), [&](int part, Offset first, Offset last) {
      T sum = before[part];
      detail::for_range(first, last, [&](Offset i) {
        const T here = static_cast<T>(count(i));
        begin(i) = sum;
        sum += here;
      });
    });
    begin(n) = total;
    return total;
  }
}

/// The least of `initial` and value(0), ..., value(n-1). Waits for it.
template <class Space, class T, class Value>
T reduce_min(const char* label, const Space& space, Offset n, T initial, const Value& value) {
  if constexpr (is_device<Space>) {
    T least = initial;
    Kokkos::parallel_reduce(
        label, detail::device_range(space, n),
        KOKKOS_LAMBDA(Offset i, T & best) {
          const T here = value(i);
          if (here < best) best = here;
        },
        Kokkos::Min<T>(least));
    return least < initial ? least : initial;
  } else {
    const std::vector<T> least = detail::of_parts(label, n, [&](Offset first, Offset last) {
      T best = initial;
      detail::for_range(first, last, [&](Offset i) {
        const T here = value(i);
        if (here < best) best = here;
      });
      return best;
    });
    return *std::min_element(least.begin(), least.end());
  }
}

/// value(0) + ... + value(n-1). Waits for it.
template <class Space, class Value>
Offset reduce_sum(const char* label, const Space& space, Offset n, const Value& value) {
  if constexpr (is_device<Space>) {
    Offset total = 0;
    Kokkos::parallel_reduce(
        label, detail::device_range(space, n), KOKKOS_LAMBDA(Offset i, Offset & sum) { sum += value(i); }, total);
    return total;
  } else {
    const std::vector<Offset> sums = detail::of_parts(label, n, [&](Offset first, Offset last) {
      Offset sum = 0;
      detail::for_range(first, last, [&](Offset i) { sum += value(i); });
      return sum;
    });
    return std::accumulate(sums.begin(), sums.end(), Offset(0));
  }
}

/// What visit(i, add) adds for i in 0..n-1, in that order. On all host threads.
template <class T, class Visit>
std::vector<T> collected(const char* label, Offset n, const Visit& visit) {
  return detail::concatenated(detail::of_parts(label, n, [&](Offset first, Offset last) {
    std::vector<T> mine;
    detail::for_range(first, last, [&](Offset i) { visit(i, [&](const T& one) { mine.push_back(one); }); });
    return mine;
  }));
}

/// The numbers i of 0..n-1 for which is_wanted(i), ascending. Waits for them.
template <class Space, class IsWanted>
Array<Id, MemoryOf<Space>> selected(const char* label, const Space& space, Offset n, const IsWanted& is_wanted) {
  if constexpr (is_device<Space>) {
    const auto all = allocate<Array<Id, MemoryOf<Space>>>(label, reduce_sum(label, space, n, is_wanted));
    Kokkos::parallel_scan(
        label, detail::device_range(space, n), KOKKOS_LAMBDA(Offset i, Offset & before, bool final) {
          if (!is_wanted(i)) return;
          if (final) all(before) = static_cast<Id>(i);
          ++before;
        });
    space.fence();
    return all;
  } else {
    const auto found = collected<Id>(label, n, [&](Offset i, const auto& add) {
      if (is_wanted(i)) add(static_cast<Id>(i));
    });
    return detail::array_of(label, found);
  }
}

namespace detail {

/// Calls kernel(team) for so many teams, which have kernel.scratch_bytes() bytes of the fast memory of level 0 each: on
/// a device teams of `warps` warps, enqueued on the instance as loops are; on the host each thread is one, of as many
/// as `items` items are worth.
template <class Space, class Kernel>
void for_teams(const char* label, const Space& space, Offset teams, int warps, Offset items, const Kernel& kernel) {
  if (teams == 0) return;
  if constexpr (is_device<Space>) {
    Kokkos::TeamPolicy<Space> policy(space, static_cast<int>(teams), warps, lanes_per_warp);
    policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(kernel.scratch_bytes() + 16)));
    Kokkos::parallel_for(label, overlapping(policy), kernel);
  } else {
    for_parts(label, teams, threads_for(items), [&](int, Offset first, Offset last) {
      std::vector<char> scratch(kernel.scratch_bytes());
      for (Offset team = first; team < last; ++team) {
        stop_if_asked_at(team);
        kernel(HostTeam(static_cast<int>(team), scratch.data()));
      }
    });
  }
}

}  // namespace detail

}  // namespace gale
