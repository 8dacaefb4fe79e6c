#pragma once

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// How many steps each thread of a launch takes at most: few, so that what it leaves open soon gets threads of its own,
/// and no launch waits for the longest way; where few ways are left, as many as take longer than another launch. A step
/// finds two entries at most, a first one three, and a thread leaves as many at most to come back to.
struct StepsOfLaunch {
  static constexpr Offset found_in(int steps) { return 2 * Offset(steps) + 1; }

  KOKKOS_FUNCTION static int most_of(Offset threads) {
    constexpr Offset of_all = 1 << 16, fewest = 8, most = 16;
    const Offset each = of_all / threads;
    return static_cast<int>(each < fewest ? fewest : each > most ? most : each);
  }

  /// The most for which each of so many threads finds no more than there is room for in all: 1 or more, if that is
  /// room for one step.
  KOKKOS_FUNCTION static int in(Offset room, Offset threads) {
    const Offset fit = (room / threads - 1) / 2, most = most_of(threads);
    return static_cast<int>(fit < most ? fit : most);
  }
};

/// Adds, as atomic_add does, what all threads of a launch add to one place: those of a warp that are here together have
/// one do it for all, as the place takes one after the other.
KOKKOS_FORCEINLINE_FUNCTION Offset add_in_turn(Offset* to, Offset value) {
#if defined(__CUDA_ARCH__)
  const LaneMask lanes = lanes_here();
  const int first = __ffs(lanes) - 1, lane = static_cast<int>(threadIdx.x + threadIdx.y * blockDim.x) % lanes_per_warp;
  Offset before = 0, all = 0;  // of lanes below this one, and of all
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const int other = __ffs(left) - 1;
    const Offset more = __shfl_sync(lanes, value, other);
    if (other < lane) before += more;
    all += more;
  }
  Offset there = 0;
  if (lane == first && all != 0) there = atomic_add(to, all);
  return __shfl_sync(lanes, there, first) + before;
#else
  return value == 0 ? Offset(0) : atomic_add(to, value);
#endif
}

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
    const Offset first = add_in_turn(count, Offset(size_));
    for (int i = 0; i < size_; ++i) list(first + i) = entries_[i];
  }

 private:
  T entries_[capacity];
  int size_ = 0;
};

}  // namespace gale::detail
