#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/device.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/rank_rows.hpp>
#include <gale/base/sort.hpp>

namespace gale {

namespace {

using Keys = Array<std::uint64_t, HostMemory>;
using Values = Array<Id, HostMemory>;

constexpr int most_digit_bits = 11;

using Histogram = std::array<Offset, 1 << most_digit_bits>;

/// The bits of keys in which some differ, and what all have in the others.
struct Bits {
  int begin = 0, end = 0;  ///< the lowest one, and one past the highest
  std::uint64_t common = 0;

  explicit Bits(const Keys& keys) {
    const Offset n = keys.extent(0);
    const std::uint64_t* const all = keys.data();
    const auto differ = detail::of_parts("GALE::sort_bits", n, [&](Offset first, Offset last) {
      std::uint64_t mine = 0;
      for (Offset i = first; i < last; ++i) mine |= all[i] ^ all[0];
      return mine;
    });
    const std::uint64_t any = std::accumulate(differ.begin(), differ.end(), std::uint64_t(0), std::bit_or<>());
    if (any == 0) return;
    begin = lowest_bit(any);
    end = highest_bit(any) + 1;
    common = all[0] & ~(~std::uint64_t(0) >> (64 - count()) << begin);
  }

  int count() const { return end - begin; }
};

/// Entries with keys and values in two arrays.
struct Pairs {
  std::uint64_t* keys;
  Id* values;

  std::uint64_t key(Offset i) const { return keys[i]; }
  void take(Offset to, const Pairs& from, Offset i) const {
    keys[to] = from.keys[i];
    values[to] = from.values[i];
  }
};

/// Entries with keys of 32 bits above their values.
struct PackedPairs {
  std::uint64_t* pairs;

  std::uint64_t key(Offset i) const { return pairs[i] >> 32; }
  void take(Offset to, const PackedPairs& from, Offset i) const { pairs[to] = from.pairs[i]; }
};

/// Where each part of the input writes its first key of each digit.
template <class Entries, class DigitOf>
void place_digits(const Entries& from, Offset n, int digits, const DigitOf& digit_of, std::vector<Histogram>& place) {
  detail::for_parts("GALE::sort_count", n, place.size(), [&, from](int part, Offset first, Offset last) {
    Histogram& mine = place[part];
    mine.fill(0);
    detail::for_range(first, last, [&](Offset i) { ++mine[digit_of(from.key(i))]; });
  });
  detail::begins_of_parts<Offset>(place, digits);
}

/// Sorts by the bits [begin, end) of the keys, digit by digit, from one array to the other and back. Returns the one
/// that they are in then.
template <class Entries>
Entries sort_by_digits(Entries from, Entries to, Offset n, int begin, int end) {
  const int passes = (end - begin + most_digit_bits - 1) / most_digit_bits;
  const Offset worth_counting = Offset(1) << most_digit_bits;  // of as many keys as there are places for each part
  std::vector<Histogram> place(std::clamp<Offset>(n / worth_counting, 1, detail::threads_for(n)));
  for (int pass = 0; pass < passes; ++pass) {
    const int bits = (end - begin + passes - pass - 1) / (passes - pass), shift = begin;
    begin += bits;
    const std::uint64_t mask = (std::uint64_t(1) << bits) - 1;
    const auto digit_of = [=](std::uint64_t key) { return key >> shift & mask; };
    place_digits(from, n, 1 << bits, digit_of, place);
    detail::for_parts("GALE::sort_move", n, place.size(), [&, from, to](int part, Offset first, Offset last) {
      Offset* const next = place[part].data();
      detail::for_range(first, last, [&](Offset i) { to.take(next[digit_of(from.key(i))]++, from, i); });
    });
    std::swap(from, to);
  }
  return from;
}

/// Sorts keys that differ in 32 bits at most, with values of which value_of(i) is the i-th.
template <class ValueOf>
void sort_packed(const Keys& all_keys, const Values& all_values, const Bits& bits, const ValueOf& value_of) {
  const Offset n = all_keys.extent(0);
  std::uint64_t* const keys = all_keys.data();
  Id* const values = all_values.data();
  parallel_for("GALE::sort_pack", HostExecutionSpace(), n, [=](Offset i) {
    keys[i] = (keys[i] ^ bits.common) >> bits.begin << 32 | static_cast<std::uint32_t>(value_of(i));
  });
  const Keys other = allocate<Keys>("GALE::sort_keys", n);
  const std::uint64_t* const sorted =
      sort_by_digits(PackedPairs{keys}, PackedPairs{other.data()}, n, 0, bits.count()).pairs;
  parallel_for("GALE::sort_unpack", HostExecutionSpace(), n, [=](Offset i) {
    const std::uint64_t pair = sorted[i];
    keys[i] = pair >> 32 << bits.begin | bits.common;
    values[i] = pair_second(pair);
  });
}

/// Sorts keys that differ in more.
void sort_pairs(const Keys& keys, const Values& values, const Bits& bits) {
  const Offset n = keys.extent(0);
  const Keys other_keys = allocate<Keys>("GALE::sort_keys", n);
  const Values other_values = allocate<Values>("GALE::sort_values", n);
  const Pairs from{keys.data(), values.data()};
  const Pairs sorted = sort_by_digits(from, Pairs{other_keys.data(), other_values.data()}, n, bits.begin, bits.end);
  if (sorted.keys == from.keys) return;
  Kokkos::deep_copy(keys, other_keys);
  Kokkos::deep_copy(values, other_values);
}

constexpr int most_packed_bits = 32;

}  // namespace

template <class Space>
void stable_sort_by_key(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& keys,
                        const Array<Id, MemoryOf<Space>>& values) {
  if (keys.extent(0) < 2) return;
  if constexpr (is_device<Space>) {
    detail::sort_by_key_on_device(space, keys, values);
  } else {
    const Bits bits(keys);
    const Id* const all = values.data();
    if (bits.count() > most_packed_bits) {
      sort_pairs(keys, values, bits);
    } else if (bits.count() > 0) {
      sort_packed(keys, values, bits, [all](Offset i) { return all[i]; });
    }
  }
}

template <class Space>
Array<Id, MemoryOf<Space>> stable_sort_places(const Space& space, const std::string& label,
                                              const Array<std::uint64_t, MemoryOf<Space>>& keys) {
  const Offset n = keys.extent(0);
  if constexpr (!is_device<Space>) {
    if (n > 1) {
      const Bits bits(keys);
      if (bits.count() > 0 && bits.count() <= most_packed_bits) {
        const auto places = allocate<Values>(label, n);
        sort_packed(keys, places, bits, [](Offset i) { return i; });
        return places;
      }
    }
  }
  const auto places = iota(label, space, n);
  stable_sort_by_key(space, keys, places);
  return places;
}

#define GALE_INSTANTIATE(Space)                                                                            \
  template GALE_EXPORT void stable_sort_by_key(const Space&, const Array<std::uint64_t, MemoryOf<Space>>&, \
                                               const Array<Id, MemoryOf<Space>>&);                         \
  template GALE_EXPORT Array<Id, MemoryOf<Space>> stable_sort_places(const Space&, const std::string&,     \
                                                                     const Array<std::uint64_t, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

namespace {

/// Entries that are ids.
struct IdEntries {
  Id* ids;

  KOKKOS_FUNCTION Id load(Offset i) const { return ids[i]; }
  KOKKOS_FUNCTION void store(Offset i, Id id) const { ids[i] = id; }
};

}  // namespace

template <class Space, class Index>
void sort_rows(const Space& space, const char* label, const Csr<Id, MemoryOf<Space>, Index>& rows) {
  const Offset count = rows.rows(), entries = rows.entries.extent(0);
  if (count == 0 || entries == 0) return;
  if constexpr (is_device<Space>) {
    // The device's library takes eight times as long for rows of some 300, but no longer for one of a million.
    constexpr int most_ranked = 2048, of_team = 256;
    const auto begin = rows.offsets;
    const Offset longest = -reduce_min(
        "GALE::longest_row", space, count, Offset(0),
        KOKKOS_LAMBDA(Offset row) { return static_cast<Offset>(begin(row) - begin(row + 1)); });
    if (longest > most_ranked) return detail::sort_rows_on_device(space, label, rows.offsets, rows.entries);
    const auto rows_of_team = static_cast<int>(std::clamp<Offset>(of_team * count / entries, 1, of_team));
    detail::rank_rows(
        label, space,
        detail::RankRows<Index, IdEntries>{{rows.entries.data()}, begin.data(), count, rows_of_team, most_ranked});
  } else {
    parallel_for(label, space, count, [&](Offset i) {
      const Span<Id> row = rows.row(i);
      if (!std::is_sorted(row.begin(), row.end())) std::sort(row.begin(), row.end());
    });
  }
}

#define GALE_INSTANTIATE(Space)                                                            \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Id>&); \
  template void sort_rows(const Space&, const char*, const Csr<Id, MemoryOf<Space>, Offset>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
