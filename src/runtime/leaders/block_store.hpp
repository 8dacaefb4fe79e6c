#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/relations/batch.hpp>

namespace gale::detail {

/// The blocks of one batch on the host, in one stretch of memory. A leader fills and publishes it; then any number of
/// consumers read it, each with a pin on it; then the leader takes it back, and fills it again.
struct Arena {
  PinnedArray<Id> words;
  std::uint64_t number = 0;       ///< among the arenas of its store, from 1
  std::vector<Id> segments;       ///< the batch's
  std::vector<Offset> directory;  ///< the batch's; see Batch

  std::atomic<int> pins{0};
  std::atomic<Id> unread{0};  ///< segments that the running sweep has still to read; not above 0: none
  std::atomic<std::int64_t> last_use{0};
  bool ahead = false;  ///< published for a sweep, which reads each block once

  /// Its blocks, of the relations given.
  Batch<HostMemory> batch(RelationSet relations, const IntervalTables<HostMemory>& intervals) const {
    return {relations, static_cast<Id>(segments.size()), segments.data(), directory.data(), words.data(), intervals};
  }

  std::size_t bytes() const { return words.size() * sizeof(Id); }
};

/// One segment's blocks in an arena that can't be taken back as long as this lives: a pin.
class Lease {
 public:
  Lease() = default;
  /// Takes over a pin that the caller has set.
  Lease(Arena& arena, Id slot) : arena_(&arena), slot_(slot) {}
  ~Lease() { release(); }
  Lease(Lease&& other) noexcept : arena_(std::exchange(other.arena_, nullptr)), slot_(other.slot_) {}
  Lease& operator=(Lease&& other) noexcept {
    if (this != &other) {
      release();
      arena_ = std::exchange(other.arena_, nullptr);
      slot_ = other.slot_;
    }
    return *this;
  }

  explicit operator bool() const { return arena_ != nullptr; }

  const Arena& arena() const { return *arena_; }
  Id slot() const { return slot_; }

  /// Another segment's blocks of the same arena from now on.
  void move_to(Id slot) { slot_ = slot; }

  /// The number of the arena.
  std::uint64_t number() const { return arena_->number; }

  /// Gives the pin back, and tells that a sweep has read so many segments. True if the arena has none left for it.
  bool release_read(Id segments) {
    Arena* const arena = std::exchange(arena_, nullptr);
    arena->pins.fetch_sub(1);
    return arena->unread.fetch_sub(segments) == segments;
  }

  void release() {
    if (arena_ != nullptr) std::exchange(arena_, nullptr)->pins.fetch_sub(1);
  }

 private:
  Arena* arena_ = nullptr;
  Id slot_ = 0;
};

/// The blocks that are resident on the host: which arena has those of which segment. Consumers look up and pin, without
/// a lock; one leader publishes, and evicts by arena, the least recently used first, when the budget is reached.
///
/// A pin is set before the entry is read again, and an arena is taken back only if it has no pin after its entries are
/// gone: so either the reader sees that they are gone, or the leader sees the pin.
class BlockStore {
 public:
  /// A store for a mesh of so many segments. Arenas take at most `budget` bytes together, unless all that are large
  /// enough are in use and one more is needed.
  BlockStore(Id segments, std::size_t budget);

  /// What a sweep has still to read takes at most so many bytes; without a call, as many as the budget.
  void limit_ahead(std::size_t bytes) { ahead_budget_ = std::min(bytes, budget_); }

  /// Allocates `count` arenas of `words` words now, in one piece.
  void prepare(std::size_t count, Offset words);

  /// The segment's blocks, pinned; nothing if they aren't resident. By any thread, wait-free but for an eviction at the
  /// same moment.
  Lease find(Id segment);

  /// Moves a lease to another segment, if its blocks are in the same arena: no pin, nothing that threads would contend
  /// for.
  bool move(Lease& lease, Id segment) const {
    const Entry entry = entries_[segment].load(std::memory_order_acquire);
    if (!lease || entry >> 32 != lease.number()) return false;
    lease.move_to(static_cast<Id>(entry & 0xffffffffu));
    return true;
  }

  bool is_resident(Id segment) const { return entries_[segment].load(std::memory_order_acquire) != absent; }

  // All below: by the leader alone.

  enum class Need {
    can_wait,  ///< give an arena only within the budget, and none that the running sweep has still to read
    must_have  ///< someone waits for it
  };

  /// An arena of at least `words` words to fill, or null. Evicts what it held.
  Arena* take(Need need, Offset words);

  /// Makes the blocks in an arena that was taken visible; those of segments whose directory says `missing` excepted.
  void publish(Arena& arena, Id unread);

  /// Gives back an arena that was taken and not published.
  void give_back(Arena& arena);

  /// No sweep reads any more. What it has read stays until its place is needed, which comes before any other.
  void forget_unread();

  std::size_t peak_bytes() const { return peak_bytes_.load(std::memory_order_relaxed); }
  std::int64_t evicted() const { return evicted_.load(std::memory_order_relaxed); }

 private:
  using Entry = std::uint64_t;  ///< arena's number + 1 above, slot below
  static constexpr Entry absent = 0;
  static constexpr std::size_t most_arenas = std::size_t(1) << 16;
  static constexpr std::size_t largest_slab = std::size_t(4) << 20;  ///< bytes

  enum class Use {
    unread,  ///< the running sweep has still to read some of it
    spent,   ///< a sweep has read all of it
    read     ///< by consumers in no order
  };

  PinnedArray<Id> allocate_words(std::size_t words);
  Arena* add_arena(PinnedArray<Id> words);
  std::size_t bytes_ahead() const;
  Arena* take_free(std::size_t words);
  Arena* find_evictable(Use use, std::size_t words);
  bool try_evict(Arena& arena);
  std::vector<Arena*>& list_of(const Arena& arena) { return arena.ahead ? ahead_ : requested_; }
  void set_entries(const Arena& arena, Entry number);

  std::unique_ptr<std::atomic<Entry>[]> entries_;
  std::vector<std::unique_ptr<Arena>> arenas_;  ///< by number; never reallocated
  std::size_t arena_count_ = 0;
  std::vector<Arena*> free_;
  std::vector<Arena*> ahead_;      ///< published for a sweep
  std::vector<Arena*> requested_;  ///< published for requests
  std::size_t slab_words_;
  PinnedArray<Id> slab_;  ///< cut into small arenas; pinning costs by the call
  std::size_t slab_used_ = 0;
  std::size_t budget_;
  std::size_t ahead_budget_ = budget_;
  std::size_t bytes_ = 0;
  std::atomic<std::size_t> peak_bytes_{0};
  std::atomic<std::int64_t> evicted_{0};
  std::atomic<std::int64_t> clock_{0};
};

}  // namespace gale::detail
