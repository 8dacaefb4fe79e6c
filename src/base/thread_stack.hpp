#pragma once

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>

namespace gale::detail {

/// What a thread of a kernel has to come back to, the latest first: up to `capacity` entries, in its own memory.
template <class T, int capacity>
class ThreadStack {
 public:
  /// To be asked before pop().
  KOKKOS_FUNCTION bool is_empty() const { return size_ == 0; }

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
