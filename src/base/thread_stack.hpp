#pragma once

#include <algorithm>

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// How many steps each thread of a launch takes at most. Where threads are many these are few, so that no launch waits
/// for the longest way; where long ways are all that is left, as many as take longer than to launch threads anew. A step
/// finds two entries at most, a first one three, and a thread leaves as many at most to come back to.
struct StepsOfLaunch {
  static constexpr Offset found_in(int steps) { return 2 * Offset(steps) + 1; }

  static int most_of(Offset threads) {
    constexpr Offset of_all = 1 << 16, fewest = 16, most = 128;
    return static_cast<int>(std::clamp(of_all / threads, fewest, most));
  }

  /// The most for which each of so many threads finds no more than there is room for in all: 1 or more, if that is
  /// room for one step.
  static int in(Offset room, Offset threads) {
    return static_cast<int>(std::min((room / threads - 1) / 2, Offset(most_of(threads))));
  }
};

/// What a thread of a kernel has to come back to, the latest first: up to `capacity` entries, in its own memory.
template <class T, int capacity>
class ThreadStack {
 public:
  /// To be asked before pop().
  KOKKOS_FUNCTION bool is_empty() const { return size_ == 0; }

  /// Whether there is room for so many more.
  KOKKOS_FUNCTION bool has_room_for(int more) const { return size_ + more <= capacity; }

  /// Adds an entry, for which there has to be room; takes out the latest.
  KOKKOS_FUNCTION void push(const T& entry) { entries_[size_++] = entry; }
  KOKKOS_FUNCTION T pop() { return entries_[--size_]; }

  /// Appends all entries to a list of so many that all threads share, which has room for them.
  KOKKOS_FUNCTION void append_to(const Array<T, WorkerMemory>& list, Offset* count) const {
    if (size_ == 0) return;
    const Offset first = atomic_add(count, Offset(size_));
    for (int i = 0; i < size_; ++i) list(first + i) = entries_[i];
  }

 private:
  T entries_[capacity];
  int size_ = 0;
};

}  // namespace gale::detail
