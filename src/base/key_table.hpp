#pragma once

#include <cstdint>

#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Bits that numbers below `count`, 1 or more, take.
inline int bits_for(Offset count) { return highest_bit(static_cast<std::uint64_t>(count - 1) | 1) + 1; }

/// Different 64-bit keys, any but the greatest one, that kernels insert: a hash table in the workers' memory, which has
/// to have more places than keys. Copies share it.
class KeyTable {
 public:
  static constexpr std::uint64_t none = ~std::uint64_t(0);  ///< no key, and the place of one that isn't there

  /// Makes a table without places: no key is there, and none may be inserted.
  KeyTable() = default;

  /// Makes an empty table with so many places, a power of two. Throws OutOfMemory.
  KeyTable(const WorkerSpace& space, Offset places)
      : keys_(allocate<Array<std::uint64_t, WorkerMemory>>("GALE::key_table", places)) {
    fill("GALE::key_table", space, keys_, none);
  }

  KOKKOS_FUNCTION Offset places() const { return static_cast<Offset>(keys_.extent(0)); }

  /// How many keys it has places for, with some to spare that keep searches short.
  KOKKOS_FUNCTION Offset room() const { return 7 * places() / 10; }

  /// A power of two that has room for so many keys.
  static Offset places_for(Offset keys) { return Offset(1) << bits_for(2 * keys); }

  /// The key at a place, or none.
  KOKKOS_FUNCTION std::uint64_t at(std::uint64_t place) const { return keys_(place); }

  /// The place of a key; `is_new` says whether it was inserted now.
  KOKKOS_FUNCTION std::uint64_t insert(std::uint64_t key, bool& is_new) const {
    return insert(key, claim(key, first_there(key)), is_new);
  }

  // A key is inserted in three steps, so that a kernel waits once for each step of several keys.

  /// Reads what is where a key is looked for first.
  KOKKOS_FUNCTION std::uint64_t first_there(std::uint64_t key) const { return atomic_read(&keys_(first_place(key))); }

  /// Claims that place for a key, when first_there(key) was `there`. Returns what was there before: none where it is
  /// the key's now.
  KOKKOS_FUNCTION std::uint64_t claim(std::uint64_t key, std::uint64_t there) const {
    return there == none ? atomic_compare_exchange(&keys_(first_place(key)), none, key) : there;
  }

  /// Inserts a key, when claim(key) was `there`.
  KOKKOS_FUNCTION std::uint64_t insert(std::uint64_t key, std::uint64_t there, bool& is_new) const {
    std::uint64_t place = first_place(key);
    while (there != none && there != key) {
      place = next_place(place);
      there = atomic_read(&keys_(place));
      if (there == none) there = atomic_compare_exchange(&keys_(place), none, key);
    }
    is_new = there == none;
    return place;
  }

  /// The place of a key that was inserted by an earlier kernel; none if there is none.
  KOKKOS_FUNCTION std::uint64_t find(std::uint64_t key) const {
    if (keys_.extent(0) == 0) return none;
    std::uint64_t place = first_place(key);
    while (keys_(place) != key) {
      if (keys_(place) == none) return none;
      place = next_place(place);
    }
    return place;
  }

 private:
  KOKKOS_FUNCTION std::uint64_t first_place(std::uint64_t key) const { return spread(key) & (keys_.extent(0) - 1); }
  KOKKOS_FUNCTION std::uint64_t next_place(std::uint64_t place) const { return (place + 1) & (keys_.extent(0) - 1); }

  Array<std::uint64_t, WorkerMemory> keys_;
};

/// An id for each of some keys, which kernels set and later ones find. Copies share them.
class IdTable {
 public:
  /// Makes a table without keys.
  IdTable() = default;

  /// Makes room for so many keys. Throws OutOfMemory.
  IdTable(const char* label, const WorkerSpace& space, Offset keys)
      : keys_(space, KeyTable::places_for(keys > 1 ? keys : 1)),
        ids_(allocate<Array<Id, WorkerMemory>>(label, keys_.places())) {}

  KOKKOS_FUNCTION void set(std::uint64_t key, Id id) const {
    bool is_new;
    ids_(keys_.insert(key, is_new)) = id;
  }

  /// The place of a key, one of places(); KeyTable::none if there is none.
  KOKKOS_FUNCTION std::uint64_t find(std::uint64_t key) const { return keys_.find(key); }
  KOKKOS_FUNCTION Offset places() const { return keys_.places(); }

  /// The id of the key at a place.
  KOKKOS_FUNCTION Id at(std::uint64_t place) const { return ids_(place); }

 private:
  KeyTable keys_;
  Array<Id, WorkerMemory> ids_;
};

}  // namespace gale::detail
