#include <gale/ttk/block_store.hpp>

namespace gale::ttk {

void BlockStore::add(Relation relation) {
  auto& slots = slots_[static_cast<int>(relation)];
  if (slots.empty()) slots = std::vector<Slot>(segments_);
}

void BlockStore::put(Relation relation, Id segment, Block block) {
  Slot& slot = slots_[static_cast<int>(relation)][segment];
  const std::lock_guard<std::mutex> lock(mutex_of(segment));
  if ((slot.state_.load(std::memory_order_acquire) & present) != 0) return;
  bytes_ += block.bytes;
  slot.block_ = std::move(block);
  slot.state_.fetch_add(present + used, std::memory_order_release);
}

/// Goes round all blocks, three times at most: one that was read since the last time around is spared twice.
void BlockStore::shrink() {
  const std::lock_guard<std::mutex> alone(shrinking_);
  for (int left = 3 * relation_count; bytes_ > budget_ && left > 0; --left) {
    auto& slots = slots_[next_relation_];
    for (; next_segment_ < static_cast<Id>(slots.size()); ++next_segment_) {
      if (bytes_ <= budget_) return;
      drop(slots[next_segment_], next_segment_, left > relation_count);
    }
    next_segment_ = 0;
    next_relation_ = (next_relation_ + 1) % relation_count;
  }
}

void BlockStore::drop(Slot& slot, Id segment, bool spare) {
  const std::uint32_t state = slot.state_.load(std::memory_order_relaxed);
  if ((state & present) == 0 || (state & holders) != 0) return;
  if ((state & used) != 0) {
    slot.state_.fetch_and(~used, std::memory_order_relaxed);
    if (spare) return;
  }
  const std::unique_lock<std::mutex> lock(mutex_of(segment), std::try_to_lock);
  std::uint32_t unread = present;
  if (!lock || !slot.state_.compare_exchange_strong(unread, 0, std::memory_order_acq_rel)) return;
  bytes_ -= slot.block_.bytes;
  slot.block_ = Block();
}

}  // namespace gale::ttk
