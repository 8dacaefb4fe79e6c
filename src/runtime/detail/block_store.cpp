#include <gale/runtime/detail/block_store.hpp>

#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/relations/block_pool.hpp>

namespace gale::detail {

BlockStore::BlockStore(Id segments, Offset arena_words, std::size_t budget)
    : entries_(new std::atomic<Entry>[segments]), arenas_(most_arenas), arena_words_(arena_words), budget_(budget) {
  for (Id s = 0; s < segments; ++s) entries_[s].store(absent, std::memory_order_relaxed);
}

Lease BlockStore::find(Id segment) {
  for (;;) {
    const Entry entry = entries_[segment].load();
    if (entry == absent) return {};
    Arena& arena = *arenas_[(entry >> 32) - 1];
    arena.pins.fetch_add(1);
    if (entries_[segment].load() == entry) {
      arena.last_use.store(clock_.fetch_add(1, std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return Lease(arena, static_cast<Id>(entry & 0xffffffffu));
    }
    arena.pins.fetch_sub(1);
  }
}

Arena* BlockStore::take(Need need) {
  if (!free_.empty()) {
    Arena* const arena = free_.back();
    free_.pop_back();
    return arena;
  }
  if (Arena* const spent = find_evictable(Use::spent)) return spent;
  const bool has_room = arena_count_ == 0 || bytes_ + static_cast<std::size_t>(arena_words_) * sizeof(Id) <= budget_;
  if (has_room) return allocate_arena();
  Arena* const read = find_evictable(Use::read);
  if (read != nullptr || need == Need::can_wait) return read;
  Arena* const unread = find_evictable(Use::unread);
  return unread != nullptr ? unread : allocate_arena();
}

Arena* BlockStore::allocate_arena() {
  if (arena_count_ == most_arenas) throw Error("consumers hold the blocks of " + std::to_string(most_arenas) + " batches at once: too many");
  auto arena = std::make_unique<Arena>();
  enlarge(*arena, arena_words_);
  arenas_[arena_count_++] = std::move(arena);
  arenas_[arena_count_ - 1]->number = arena_count_;
  return arenas_[arena_count_ - 1].get();
}

void BlockStore::enlarge(Arena& arena, Offset words) {
  if (static_cast<Offset>(arena.words.size()) >= words) return;
  const std::size_t before = arena.bytes();
  arena.words = PinnedArray<Id>();
  arena.words = PinnedArray<Id>(words);
  bytes_ += arena.bytes() - before;
  if (bytes_ > peak_bytes_.load()) peak_bytes_.store(bytes_);
}

BlockStore::Use BlockStore::use_of(const Arena& arena) {
  if (arena.unread.load() > 0) return Use::unread;
  return arena.ahead ? Use::spent : Use::read;
}

Arena* BlockStore::find_evictable(Use use) {
  // By age; of what a sweep has still to read, what it will read last. A retry for each that a consumer pins at the same moment.
  std::vector<std::pair<std::int64_t, Arena*>> candidates;
  for (Arena* const arena : published_) {
    if (arena->pins.load() != 0 || use_of(*arena) != use) continue;
    const std::int64_t age =
        use == Use::unread ? -std::int64_t(arena->segments.front()) : arena->last_use.load(std::memory_order_relaxed);
    candidates.emplace_back(age, arena);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& candidate : candidates) {
    if (try_evict(*candidate.second)) return candidate.second;
  }
  return nullptr;
}

bool BlockStore::try_evict(Arena& arena) {
  set_entries(arena, absent);
  if (arena.pins.load() != 0) {
    set_entries(arena, arena.number);
    return false;
  }
  evicted_.fetch_add(static_cast<std::int64_t>(arena.segments.size()), std::memory_order_relaxed);
  published_.erase(std::find(published_.begin(), published_.end(), &arena));
  return true;
}

void BlockStore::set_entries(const Arena& arena, Entry number) {
  const std::size_t relations = arena.segments.empty() ? 0 : arena.directory.size() / arena.segments.size();
  for (std::size_t slot = 0; slot < arena.segments.size(); ++slot) {
    if (arena.directory[slot * relations] == BlockPool::missing) continue;
    entries_[arena.segments[slot]].store(number == absent ? absent : number << 32 | slot);
  }
}

void BlockStore::publish(Arena& arena, Id unread) {
  arena.ahead = unread > 0;
  arena.unread.store(unread);
  arena.last_use.store(clock_.fetch_add(1, std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  published_.push_back(&arena);
  set_entries(arena, arena.number);
}

void BlockStore::give_back(Arena& arena) { free_.push_back(&arena); }

void BlockStore::forget_unread() {
  for (Arena* const arena : published_) {
    arena->unread.store(0);
    arena->ahead = false;
  }
}

}  // namespace gale::detail
