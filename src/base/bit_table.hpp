#pragma once

#include <cstddef>
#include <cstdint>

#include <gale/base/atomic.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Different numbers below a bound that kernels insert: a bit each, in the workers' memory. Where many are inserted it
/// is smaller than a KeyTable, and asks memory once where that asks twice. Copies share it.
class BitTable {
 public:
  /// Makes a table that nobody may ask, nor insert to.
  BitTable() = default;

  /// Makes an empty table of numbers below `bound`. Throws OutOfMemory.
  BitTable(const char* label, const WorkerSpace& space, Offset bound)
      : words_(allocate<Array<std::uint64_t, WorkerMemory>>(label, (static_cast<std::size_t>(bound) + 63) >> 6)) {
    fill(label, space, words_, std::uint64_t(0));
  }

  /// Inserts a number; false if it was there.
  KOKKOS_FUNCTION bool insert(Offset number) const {
    return (atomic_or(&words_(number >> 6), bit_of(number)) & bit_of(number)) == 0;
  }

  /// Inserts a number that is likely to be there.
  KOKKOS_FUNCTION void insert_again(Offset number) const {
    if ((atomic_read(&words_(number >> 6)) & bit_of(number)) == 0) insert(number);
  }

  /// Whether an earlier kernel has inserted a number.
  KOKKOS_FUNCTION bool has(Offset number) const { return (words_(number >> 6) & bit_of(number)) != 0; }

  /// The bits, 64 a word; those from the bound on are 0.
  const Array<std::uint64_t, WorkerMemory>& words() const { return words_; }

 private:
  KOKKOS_FUNCTION static std::uint64_t bit_of(Offset number) { return std::uint64_t(1) << (number & 63); }

  Array<std::uint64_t, WorkerMemory> words_;
};

}  // namespace gale::detail
