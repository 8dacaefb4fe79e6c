#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/runtime/leaders/block_store.hpp>

namespace gale::detail {

BlockStore::BlockStore(Id segments, std::size_t budget)
    : entries_(new std::atomic<Entry>[segments]),
      arenas_(most_arenas),
      slab_words_(std::min(largest_slab, budget / 8) / sizeof(Id)),
      budget_(budget) {
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

Arena* BlockStore::take(Need need, Offset words) {
  const auto size = static_cast<std::size_t>(words);
  if (Arena* const free = take_free(size)) return free;
  if (Arena* const spent = find_evictable(Use::spent, size)) return spent;
  if (need == Need::can_wait && bytes_ahead() > 0 && bytes_ahead() + size * sizeof(Id) > ahead_budget_) return nullptr;
  const bool has_room = arena_count_ == 0 || bytes_ + size * sizeof(Id) <= budget_;
  if (has_room) return add_arena(allocate_words(size));
  Arena* const read = find_evictable(Use::read, size);
  if (read != nullptr || need == Need::can_wait) return read;
  Arena* const unread = find_evictable(Use::unread, size);
  return unread != nullptr ? unread : add_arena(allocate_words(size));
}

/// The smallest that is large enough.
Arena* BlockStore::take_free(std::size_t words) {
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it) {
    if ((*it)->words.size() >= words && (best == free_.end() || (*it)->words.size() < (*best)->words.size())) best = it;
  }
  if (best == free_.end()) return nullptr;
  Arena* const arena = *best;
  free_.erase(best);
  return arena;
}

PinnedArray<Id> BlockStore::allocate_words(std::size_t words) {
  if (words > slab_words_ / 4) return PinnedArray<Id>(words);
  if (slab_.size() < slab_used_ + words) {
    slab_ = PinnedArray<Id>(slab_words_);
    slab_used_ = 0;
  }
  slab_used_ += words;
  return slab_.slice(slab_used_ - words, words);
}

void BlockStore::prepare(std::size_t count, Offset words) {
  const auto each = static_cast<std::size_t>(words);
  const PinnedArray<Id> all(count * each);
  for (std::size_t i = 0; i < count; ++i) free_.push_back(add_arena(all.slice(i * each, each)));
}

std::size_t BlockStore::bytes_ahead() const {
  std::size_t bytes = 0;
  for (const Arena* const arena : ahead_) bytes += arena->bytes();
  return bytes;
}

Arena* BlockStore::add_arena(PinnedArray<Id> words) {
  if (arena_count_ == most_arenas)
    throw Error("more than " + std::to_string(most_arenas) + " batches on the host at once: too many");
  auto arena = std::make_unique<Arena>();
  arena->words = std::move(words);
  arena->number = arena_count_ + 1;
  bytes_ += arena->bytes();
  peak_bytes_.store(std::max(peak_bytes_.load(), bytes_));
  arenas_[arena_count_] = std::move(arena);
  return arenas_[arena_count_++].get();
}

Arena* BlockStore::find_evictable(Use use, std::size_t words) {
  // The oldest first; of what a sweep has still to read, what it will read last. A retry for each that a consumer pins
  // at the same moment.
  std::vector<std::pair<std::int64_t, Arena*>> candidates;
  for (Arena* const arena : use == Use::read ? requested_ : ahead_) {
    const bool unread = arena->unread.load() > 0;
    if (arena->pins.load() != 0 || arena->words.size() < words || unread != (use == Use::unread)) continue;
    const std::int64_t age = unread ? -std::int64_t(*std::min_element(arena->segments.begin(), arena->segments.end()))
                                    : arena->last_use.load(std::memory_order_relaxed);
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
  auto& list = list_of(arena);
  list.erase(std::find(list.begin(), list.end(), &arena));
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
  list_of(arena).push_back(&arena);
  set_entries(arena, arena.number);
}

void BlockStore::give_back(Arena& arena) { free_.push_back(&arena); }

void BlockStore::forget_unread() {
  for (Arena* const arena : ahead_) arena->unread.store(0);
}

}  // namespace gale::detail
