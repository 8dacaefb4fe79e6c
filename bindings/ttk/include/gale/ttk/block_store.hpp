#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include <gale/export.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale::ttk {

/// The rows of one relation for one segment, in memory of its own.
struct Block {
  Block() = default;

  /// With room for so many entries of consecutive rows; all is to be written.
  Block(Id first, Id count, std::size_t entries)
      : words(new Id[count + 1 + entries]), bytes((count + 1 + entries) * sizeof(Id)) {
    rows = BlockLayout{first, count}.rows_in(words.get());
  }

  Rows rows;  ///< of the segment's simplices (GALE's ids); entries are TTK's ids
  std::unique_ptr<Id[]> words;
  std::size_t bytes = 0;
};

/// Blocks that all threads share, made when they are first wanted. Those that no thread holds are dropped, the longest
/// unread about first, as soon as all take more than a budget. Any thread may call anything.
class GALE_EXPORT BlockStore {
 public:
  /// Where a block is or may be. Its holders are counted in the low bits of the state.
  class Slot {
   public:
    const Rows& rows() const { return block_.rows; }

   private:
    friend class BlockStore;
    std::atomic<std::uint32_t> state_{0};
    Block block_;
  };

  BlockStore(Id segments, std::size_t budget) : segments_(segments), budget_(budget) {}

  /// Before blocks of a relation are held. Not while others call anything.
  void add(Relation relation);

  /// Holds a block, so that it stays. make(): computes it if it isn't there; what it throws goes through.
  template <class Make>
  Slot& hold(Relation relation, Id segment, const Make& make);

  /// Holds a block that is there as `hold` does; null if it isn't.
  Slot* hold_present(Relation relation, Id segment);

  /// Has a block there, unless it is, until its place is needed.
  void put(Relation relation, Id segment, Block block);

  void release(Slot& slot) { slot.state_.fetch_sub(1, std::memory_order_release); }

  /// Counts the bytes of all blocks that are there.
  std::size_t bytes() const { return bytes_; }
  std::size_t budget() const { return budget_; }

  /// Not while others call anything.
  void set_budget(std::size_t budget) { budget_ = budget; }

 private:
  static constexpr std::uint32_t present = std::uint32_t(1) << 31, used = std::uint32_t(1) << 30, holders = used - 1;

  std::mutex& mutex_of(Id segment) { return mutexes_[static_cast<std::size_t>(segment) % mutexes_.size()]; }
  void shrink();
  void drop(Slot& slot, Id segment, bool spare);

  const Id segments_;
  std::size_t budget_;
  std::array<std::vector<Slot>, relation_count> slots_;
  std::array<std::mutex, 256> mutexes_;  ///< who makes or drops a block has that of its segment
  std::atomic<std::size_t> bytes_{0};
  std::mutex shrinking_;
  int next_relation_ = 0;  ///< where the next look for something to drop begins
  Id next_segment_ = 0;
};

inline BlockStore::Slot* BlockStore::hold_present(Relation relation, Id segment) {
  Slot& slot = slots_[static_cast<int>(relation)][segment];
  const std::uint32_t state = slot.state_.fetch_add(1, std::memory_order_acquire);
  if ((state & present) == 0) {
    slot.state_.fetch_sub(1, std::memory_order_relaxed);
    return nullptr;
  }
  if ((state & used) == 0) slot.state_.fetch_or(used, std::memory_order_relaxed);
  return &slot;
}

template <class Make>
BlockStore::Slot& BlockStore::hold(Relation relation, Id segment, const Make& make) {
  if (Slot* const held = hold_present(relation, segment)) return *held;
  Slot& slot = slots_[static_cast<int>(relation)][segment];
  {
    const std::lock_guard<std::mutex> lock(mutex_of(segment));
    if ((slot.state_.load(std::memory_order_acquire) & present) != 0) {
      slot.state_.fetch_add(1, std::memory_order_acquire);
      return slot;
    }
    slot.block_ = make();
    bytes_ += slot.block_.bytes;
    slot.state_.fetch_add(present + used + 1, std::memory_order_release);
  }
  if (bytes_ > budget_) shrink();
  return slot;
}

}  // namespace gale::ttk
