#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>

namespace gale {

/// A value for each of some 64-bit keys (`pair_key` makes them of ids): open addressing, at most half full, on the
/// host. Clearing it takes no time, so that one table serves many small sets of keys one after the other.
template <class Value>
class HashTable {
 public:
  /// With room for as many keys; it grows when there are more.
  explicit HashTable(std::size_t keys = 512) {
    std::size_t size = 16;
    while (size < 2 * keys) size *= 2;
    slots_.resize(size);
  }

  /// Forgets all keys, and keeps its memory.
  void clear() {
    used_ = 0;
    if (++age_ != 0) return;
    for (Slot& slot : slots_) slot.age = 0;
    age_ = 1;
  }

  /// The value of a key, and whether the key is new: then the value isn't set. Valid until the next call.
  std::pair<Value&, bool> insert(std::uint64_t key) {
    if (2 * used_ >= slots_.size()) grow();
    Slot& slot = slots_[place_of(key)];
    if (slot.age == age_) return {slot.value, false};
    ++used_;
    slot.age = age_;
    slot.high = static_cast<std::uint32_t>(key >> 32);
    slot.low = static_cast<std::uint32_t>(key);
    return {slot.value, true};
  }

  /// The value of a key; nullptr if there is none. Valid until the next call of `insert`.
  const Value* find(std::uint64_t key) const {
    const Slot& slot = slots_[place_of(key)];
    return slot.age == age_ ? &slot.value : nullptr;
  }

  std::size_t size() const { return used_; }

 private:
  /// In use if its age is the table's. The key lies in two halves, so that small values make small slots.
  struct Slot {
    std::uint32_t high = 0, low = 0, age = 0;
    Value value{};

    std::uint64_t key() const { return std::uint64_t(high) << 32 | low; }
  };

  std::size_t place_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = static_cast<std::size_t>(spread(key)) & mask;
    while (slots_[place].age == age_ && slots_[place].key() != key) place = (place + 1) & mask;
    return place;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.age == age_) slots_[place_of(slot.key())] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::uint32_t age_ = 1;
};

}  // namespace gale
