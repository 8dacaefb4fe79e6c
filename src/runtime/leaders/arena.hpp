#pragma once

#include <atomic>
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
  std::vector<Id> segments;       ///< of the batch
  std::vector<Offset> directory;  ///< of it; see Batch

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

}  // namespace gale::detail
