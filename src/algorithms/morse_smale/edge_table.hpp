#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/pair_key.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// A value for each of the edges of one surface after the other: open addressing, in which entries of earlier surfaces
/// count as empty.
template <class Value>
class EdgeTable {
 public:
  EdgeTable() : slots_(1024) {}

  void clear() {
    used_ = 0;
    if (++age_ != 0) return;
    for (Slot& slot : slots_) slot.age = 0;
    age_ = 1;
  }

  /// The value of an edge, and whether it is new: then it isn't set. Valid until the next call.
  std::pair<Value&, bool> insert(Id high, Id low) {
    if (2 * used_ >= slots_.size()) grow();
    Slot& slot = slots_[place_of(high, low)];
    if (slot.age == age_) return {slot.value, false};
    ++used_;
    slot.age = age_;
    slot.high = high;
    slot.low = low;
    return {slot.value, true};
  }

  /// Of an edge that is there.
  const Value& operator()(Id high, Id low) const { return slots_[place_of(high, low)].value; }

 private:
  struct Slot {
    Id high = no_id, low = no_id;
    std::uint32_t age = 0;
    Value value{};
  };

  std::size_t place_of(Id high, Id low) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = static_cast<std::size_t>(spread(pair_key(high, low))) & mask;
    while (slots_[place].age == age_ && (slots_[place].high != high || slots_[place].low != low))
      place = (place + 1) & mask;
    return place;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.age == age_) slots_[place_of(slot.high, slot.low)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::uint32_t age_ = 1;
};

}  // namespace gale::detail
