#pragma once

#include <memory>
#include <vector>

#include <gale/runtime/detail/arena.hpp>

namespace gale::detail {

/// The blocks that are resident on the host: which arena has those of which segment. Consumers look up and pin, without a lock; one leader
/// publishes, and evicts by arena, the least recently used first, when the budget is reached.
///
/// A pin is set before the entry is read again, and an arena is taken back only if it has no pin after its entries are gone: so
/// either the reader sees that they are gone, or the leader sees the pin.
class BlockStore {
 public:
  /// For a mesh of so many segments. Arenas have `arena_words` words each, unless one segment needs more; together at most `budget` bytes,
  /// unless all are in use and one more is needed.
  BlockStore(Id segments, Offset arena_words, std::size_t budget);

  /// The segment's blocks, pinned; nothing if they aren't resident. By any thread, wait-free but for an eviction at the same moment.
  Lease find(Id segment);

  bool is_resident(Id segment) const { return entries_[segment].load(std::memory_order_acquire) != absent; }

  // All below: by the leader alone.

  enum class Need {
    can_wait,  ///< give an arena only within the budget, and none that the running sweep has still to read
    must_have  ///< someone waits for it
  };

  /// An arena to fill, or null. Evicts what it held.
  Arena* take(Need need);

  /// Makes room for `words` words in an arena that was taken.
  void enlarge(Arena& arena, Offset words);

  /// Makes the blocks in an arena that was taken visible; those of segments whose directory says `missing` excepted.
  void publish(Arena& arena, Id unread);

  /// Gives back an arena that was taken and not published.
  void give_back(Arena& arena);

  /// No sweep reads any more.
  void forget_unread();

  Offset arena_words() const { return arena_words_; }
  std::size_t peak_bytes() const { return peak_bytes_.load(std::memory_order_relaxed); }
  std::int64_t evicted() const { return evicted_.load(std::memory_order_relaxed); }

 private:
  using Entry = std::uint64_t;  ///< arena's number + 1 above, slot below
  static constexpr Entry absent = 0;
  static constexpr std::size_t most_arenas = std::size_t(1) << 16;

  Arena* allocate_arena();
  enum class Use {
    unread,  ///< the running sweep has still to read some of it
    spent,   ///< a sweep has read all of it
    read     ///< by consumers in no order
  };

  static Use use_of(const Arena& arena);
  Arena* find_evictable(Use use);
  bool try_evict(Arena& arena);
  void set_entries(const Arena& arena, Entry number);

  std::unique_ptr<std::atomic<Entry>[]> entries_;
  std::vector<std::unique_ptr<Arena>> arenas_;  ///< by number; never reallocated
  std::size_t arena_count_ = 0;
  std::vector<Arena*> free_;
  std::vector<Arena*> published_;
  Offset arena_words_;
  std::size_t budget_;
  std::size_t bytes_ = 0;
  std::atomic<std::size_t> peak_bytes_{0};
  std::atomic<std::int64_t> evicted_{0};
  std::atomic<std::int64_t> clock_{0};
};

}  // namespace gale::detail
