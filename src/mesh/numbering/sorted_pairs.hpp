#pragma once

#include <cstdint>

#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

/// The distinct values of rows that have too many for one thread: pairs of row and value are written down, as keys of
/// `pair_key`, by each item that has them, and sorted. n log n time, and 36 bytes for each of n pairs.
template <class Space>
class SortedPairs {
 public:
  using Memory = MemoryOf<Space>;
  using Ids = Array<Id, Memory>;
  using Offsets = Array<Offset, Memory>;
  using Keys = Array<std::uint64_t, Memory>;

  /// Holds no pairs.
  SortedPairs() = default;

  /// Holds those of the items 0..items-1. `visit_pairs(item, visit)` calls visit(key) for each pair of an item, the
  /// same ones each time; on a device it is a functor whose call operator is a template.
  template <class VisitPairs>
  SortedPairs(const Space& space, Offset items, const VisitPairs& visit_pairs) : space_(space) {
    gather(items, visit_pairs);
    stable_sort_by_key(space_, keys_, Ids("GALE::no_values", keys_.extent(0)));
    number();
  }

  /// count[row] = how many values there are, for each row that has some. Leaves other rows as they are.
  void write_counts(const Ids& count) const {
    const auto keys = keys_;
    const auto number = number_;
    const Offset n = keys.extent(0);
    parallel_for(
        "GALE::count_sorted_pairs", space_, n, KOKKOS_LAMBDA(Offset i) {
          const Id row = pair_first(keys(i));
          const bool is_last = i + 1 == n || pair_first(keys(i + 1)) != row;
          if (is_last) count(row) = static_cast<Id>(number(i + 1) - number(first_of(keys, row)));
        });
  }

  /// Writes the values, ascending in each row. begin[row] is where those of a row are.
  void write(const Ids& begin, const Ids& values) const {
    const auto keys = keys_;
    const auto number = number_;
    parallel_for(
        "GALE::write_sorted_pairs", space_, keys.extent(0), KOKKOS_LAMBDA(Offset i) {
          if (number(i + 1) == number(i)) return;
          const Id row = pair_first(keys(i));
          values(begin(row) + number(i) - number(first_of(keys, row))) = pair_second(keys(i));
        });
  }

  // The steps of construction; nvcc wants them public, as their lambdas are kernels.

  template <class VisitPairs>
  void gather(Offset items, const VisitPairs& visit_pairs) {
    const Offset count = reduce_sum(
        "GALE::count_pairs", space_, items, KOKKOS_LAMBDA(Offset i) {
          Offset pairs = 0;
          visit_pairs(static_cast<Id>(i), [&](std::uint64_t) { ++pairs; });
          return pairs;
        });
    const auto keys = allocate<Keys>("GALE::pairs", count);
    const Offsets next("GALE::next_pair", 1);
    parallel_for(
        "GALE::gather_pairs", space_, items, KOKKOS_LAMBDA(Offset i) {
          visit_pairs(static_cast<Id>(i), [&](std::uint64_t key) { keys(atomic_add(&next(0), Offset(1))) = key; });
        });
    keys_ = keys;
  }

  /// number[i] = how many different keys come before the i-th.
  void number() {
    const auto keys = keys_;
    number_ = allocate<Offsets>("GALE::pair_number", keys.extent(0) + 1);
    exclusive_scan(
        "GALE::number_pairs", space_, keys.extent(0), number_,
        KOKKOS_LAMBDA(Offset i) { return i + 1 == Offset(keys.extent(0)) || keys(i) != keys(i + 1) ? 1 : 0; });
  }

  /// Place of the first key of a row.
  KOKKOS_FUNCTION static Offset first_of(const Keys& keys, Id row) {
    return bisect(Offset(0), Offset(keys.extent(0)), [&](Offset i) { return pair_first(keys(i)) < row; });
  }

 private:
  Space space_;
  Keys keys_;
  Offsets number_;
};

}  // namespace gale::detail
