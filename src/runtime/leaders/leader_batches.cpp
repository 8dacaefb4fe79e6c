#include <algorithm>
#include <new>

#include <gale/base/error.hpp>
#include <gale/runtime/leaders/leader.hpp>

// How a leader forms batches, launches them, and takes them back.

namespace gale::detail {

/// Whether the exception that is being handled says that memory ran out: ours, or the standard library's.
bool Leader::is_out_of_memory() {
  try {
    throw;
  } catch (const OutOfMemory&) {
    return true;
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// The segment, and those that follow it and are wanted, up to what one request computes.
void Leader::plan_from(Id segment) {
  Plan plan;
  const Id count = std::min(parameters_.segments_per_request, segments_that_fit());
  const Id end = static_cast<Id>(std::min<Offset>(mesh_.segments(), Offset(segment) + count));
  for (Id s = segment; s < end; ++s) {
    if (!is_wanted(s)) continue;
    under_way_[s] = true;
    plan.segments.push_back(s);
  }
  plans_.push_back(std::move(plan));
}

/// What the blocks of so many segments will take, by those so far.
Offset Leader::words_for(std::size_t segments) const {
  constexpr double margin = 1.1;
  constexpr Offset step = 4096;
  const auto words = static_cast<Offset>(margin * words_per_segment_ * static_cast<double>(segments));
  return std::min((words + step) / step * step, parameters_.arena_words);
}

Id Leader::segments_that_fit() const {
  return std::max(Id(1), static_cast<Id>(0.9 * parameters_.arena_words / words_per_segment_));
}

/// Puts a batch on an idle worker; false if there is none, or nothing to do.
bool Leader::launch_next() {
  if (idle_.empty()) return false;
  if (plans_.empty()) return sweeping_ && launch_ahead();
  Plan plan = next_requests();
  Arena& arena = *store_.take(BlockStore::Need::must_have, std::max(plan.words, words_for(plan.segments.size())));
  launch(std::move(plan), arena);
  return true;
}

/// All requests that wait, as far as they fit one batch; what needs something special, by itself.
Leader::Plan Leader::next_requests() {
  Plan batch = std::move(plans_.front());
  plans_.pop_front();
  const auto most = static_cast<std::size_t>(segments_that_fit());
  while (!batch.alone && !plans_.empty() && !plans_.front().alone &&
         batch.segments.size() + plans_.front().segments.size() <= most) {
    batch.segments.insert(batch.segments.end(), plans_.front().segments.begin(), plans_.front().segments.end());
    plans_.pop_front();
  }
  return batch;
}

/// The next batch of the sweep, unless the budget doesn't allow it yet.
bool Leader::launch_ahead() {
  while (ahead_ < mesh_.owned_segments().last && !is_wanted(ahead_)) ++ahead_;
  if (ahead_ == mesh_.owned_segments().last) return false;
  const auto need = must_reach_ > ahead_ ? BlockStore::Need::must_have : BlockStore::Need::can_wait;
  Arena* const arena = store_.take(need, words_for(std::min(ahead_batch_, segments_that_fit())));
  if (arena == nullptr) return false;
  launch(plan_ahead(), *arena);
  return true;
}

Leader::Plan Leader::plan_ahead() {
  Plan plan;
  plan.ahead = true;
  const auto count = static_cast<std::size_t>(std::min(ahead_batch_, segments_that_fit()));
  for (; ahead_ < mesh_.owned_segments().last && plan.segments.size() < count; ++ahead_) {
    if (!is_wanted(ahead_)) continue;
    under_way_[ahead_] = true;
    plan.segments.push_back(ahead_);
  }
  ahead_batch_ = static_cast<Id>(std::min<Offset>(Offset(ahead_batch_) * 2, mesh_.owned_segments().size()));
  return plan;
}

void Leader::launch(Plan plan, Arena& arena) {
  BatchWorker* const worker = idle_.back();
  BatchPlan in_arena = plan;
  in_arena.words = static_cast<Offset>(arena.words.size());
  try {
    worker->launch(in_arena);
  } catch (...) {
    worker->abandon();
    const bool is_too_big = is_out_of_memory();
    if (is_too_big && plan.count() == 1 && launch_on_host(plan, in_arena, arena)) return;
    store_.give_back(arena);
    if (!is_too_big || plan.count() == 1) throw;
    plan_again(plan, all_of(plan));
    return;
  }
  idle_.pop_back();
  flights_.push_back({std::move(plan), worker, nullptr, &arena, Clock::now(), false});
}

/// Has a segment computed that the device has no memory for; false if the leader has nobody on the host.
bool Leader::launch_on_host(const Plan& plan, const BatchPlan& in_arena, Arena& arena) {
  if (!parameters_.make_host_worker) return false;
  const std::shared_ptr<BatchWorker> worker = parameters_.make_host_worker();
  worker->launch(in_arena);
  flights_.push_back({plan, worker.get(), worker, &arena, Clock::now(), false});
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.segments_on_host;
  return true;
}

/// A flight's worker has nothing to do.
void Leader::release(const Flight& flight) {
  if (!flight.on_host) idle_.push_back(flight.worker);
}

/// Tries again what a plan's batch lacked, before all other plans.
void Leader::plan_again(const Plan& plan, const BatchShortfall& lacked) {
  std::vector<BatchPlan> halves = in_halves(plan, lacked);
  for (auto half = halves.rbegin(); half != halves.rend(); ++half)
    plans_.push_front({std::move(*half), plan.ahead, true});
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.batches_split;
}

void Leader::begin_copy(Flight& flight) {
  if (!flight.copying) flight.worker->begin_copy(*flight.arena);
  flight.copying = true;
}

void Leader::finish_oldest() {
  // The next copy begins before this one's blocks are published, so that the link never rests.
  for (std::size_t i = 0; i < std::min<std::size_t>(flights_.size(), 2); ++i) begin_copy(flights_[i]);
  const BatchShortfall lacked = flights_.front().worker->finish(*flights_.front().arena);
  const auto finished = Clock::now();
  const Flight flight = std::move(flights_.front());
  flights_.pop_front();
  release(flight);
  std::vector<Id> made;
  const std::size_t relations = parameters_.relations.count();
  for (std::size_t slot = 0; slot < flight.arena->segments.size(); ++slot) {
    if (flight.arena->directory[slot * relations] != BlockPool::missing) made.push_back(flight.arena->segments[slot]);
  }
  account(made, lacked, flight.plan.segments.size());
  if (made.empty()) {
    store_.give_back(*flight.arena);
  } else {
    store_.publish(*flight.arena, sweeping_ && flight.plan.ahead ? static_cast<Id>(made.size()) : 0);
    deliver(made, flight.launched, finished);
  }
  if (!lacked.segments.empty()) plan_again(flight.plan, lacked);
}

void Leader::account(const std::vector<Id>& made, const BatchShortfall& lacked, std::size_t launched) {
  std::int64_t again = 0;
  for (const Id segment : made) {
    again += computed_[segment] ? 1 : 0;
    computed_[segment] = true;
    under_way_[segment] = false;
  }
  const double words = static_cast<double>(lacked.words) / static_cast<double>(launched);
  words_per_segment_ = std::max(words, 0.75 * words_per_segment_ + 0.25 * words);
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.batches;
  statistics_.segments_computed += static_cast<std::int64_t>(made.size());
  statistics_.segments_recomputed += again;
  statistics_.bytes += lacked.words * static_cast<Offset>(sizeof(Id));
  statistics_.blocks_evicted = store_.evicted();
}

}  // namespace gale::detail
