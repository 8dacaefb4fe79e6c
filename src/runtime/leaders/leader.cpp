#include <algorithm>
#include <new>

#include <gale/base/error.hpp>
#include <gale/runtime/leaders/leader.hpp>

namespace gale::detail {

namespace {

/// Batches of a sweep begin small, so that consumers can begin, and double.
constexpr Id first_batch = 32;

/// A guess for the first batch: what the blocks of a regular mesh take.
double words_per_vertex(RelationSet relations) {
  constexpr int words_of_links = 22;
  double sum = relations.has_links() ? 1 + words_of_links : 1;
  for (const Relation relation : members_of(relations)) sum += traits_of(relation).words_of_vertex;
  return sum;
}

/// Whether the exception that is being handled says that memory ran out: ours, or the standard library's.
bool is_out_of_memory() {
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

/// What the exception that is being handled says.
std::string current_message() {
  try {
    throw;
  } catch (const std::exception& error) {
    return std::string(error.what()) + (is_out_of_memory() ? ", for one segment" : "");
  } catch (...) {
    return "unknown exception";
  }
}

}  // namespace

Leader::Leader(const Mesh& mesh, const LeaderParameters& parameters, std::vector<std::unique_ptr<BatchWorker>> workers)
    : mesh_(mesh),
      parameters_(parameters),
      workers_(std::move(workers)),
      store_(mesh.segments(), parameters.host_budget),
      intervals_(interval_tables(mesh)),
      under_way_(mesh.segments()),
      computed_(mesh.segments()),
      words_per_segment_(words_per_vertex(parameters.relations) * mesh.vertices() / std::max(mesh.segments(), Id(1))) {
  for (const auto& worker : workers_) idle_.push_back(worker.get());
  prepare_arenas();
  statistics_.relations = parameters.relations;
  thread_ = std::thread([this] { run(); });
}

Leader::~Leader() { end(); }

/// What a sweep runs through again and again, so that its memory is there, locked, and soon in the caches; less where
/// the blocks of all segments take less.
void Leader::prepare_arenas() {
  constexpr std::size_t most = 12;
  const std::size_t bytes = static_cast<std::size_t>(parameters_.arena_words) * sizeof(Id);
  if (bytes == 0) return;
  store_.limit_ahead(most * bytes);
  const double all = 1.2 * words_per_segment_ * mesh_.segments() / static_cast<double>(parameters_.arena_words);
  const std::size_t count = std::min({most, parameters_.host_budget / bytes, static_cast<std::size_t>(all) + 1});
  if (have_device && count > 0) store_.prepare(count, parameters_.arena_words);
}

void Leader::end() {
  ending_ = true;
  queue_.stop();
  if (thread_.joinable()) thread_.join();
  while (consumers_inside_.load() != 0) std::this_thread::yield();
}

Lease Leader::acquire(Id segment, bool in_sweep, ConsumerStatistics& statistics) {
  if (ending_) throw Error(end_message());
  if (Lease lease = store_.find(segment)) {
    ++statistics.hits;
    return lease;
  }
  struct Inside {
    std::atomic<int>& count;
    explicit Inside(std::atomic<int>& consumers) : count(consumers) { ++count; }
    ~Inside() { --count; }
  } inside(consumers_inside_);
  const auto ticket = std::make_shared<Ticket>();
  ticket->begun = Clock::now();
  if (!queue_.push({segment, in_sweep, ticket})) throw Error(end_message());
  const auto pushed = Clock::now();
  Lease lease = ticket->wait();
  if (ending_) throw Error(end_message());
  ++statistics.requests;
  auto& waiting = statistics.waiting;
  waiting.push += seconds_between(ticket->begun, pushed);
  waiting.queue += std::max(0.0, seconds_between(pushed, ticket->taken));
  waiting.preparation += seconds_between(ticket->taken, ticket->launched);
  waiting.kernel_and_transfer += seconds_between(ticket->launched, ticket->finished);
  waiting.integration += seconds_between(ticket->finished, Clock::now());
  return lease;
}

void Leader::run() {
  while (!stopping_) {
    try {
      const bool idle = flights_.empty() && !launch_next();
      listen(idle);
      while (launch_next()) {
      }
      if (!flights_.empty() && !stopping_) finish_oldest();
    } catch (...) {
      fail_all("computing " + name_of(parameters_.relations) + " failed: " + current_message());
    }
  }
  for (const auto& request : queue_.take(false).requests) waiting_.emplace(request.segment, request.ticket);
  fail_all(end_message());
}

std::string Leader::end_message() const {
  return "the runtime ended while a consumer waited for " + name_of(parameters_.relations);
}

void Leader::listen(bool wait) {
  const auto news = queue_.take(wait);
  const auto now = Clock::now();
  stopping_ = news.stop;
  if (news.sweep_ended) {
    sweeping_ = false;
    store_.forget_unread();
  }
  if (news.sweep_began) {
    sweeping_ = true;
    ahead_ = must_reach_ = 0;
    ahead_batch_ = first_batch;
  }
  // First all of them where a failure finds them; after that, a ticket may be fulfilled with another's.
  for (const auto& request : news.requests) {
    request.ticket->taken = request.ticket->launched = request.ticket->finished = now;
    waiting_.emplace(request.segment, request.ticket);
  }
  for (const auto& request : news.requests) serve(request, now);
}

void Leader::serve(const Request& request, Clock::time_point taken) {
  if (store_.is_resident(request.segment)) {
    Plan there;
    there.segments = {request.segment};
    deliver(there, taken, taken);
    return;
  }
  if (under_way_[request.segment]) return;
  if (request.in_sweep && sweeping_ && request.segment >= ahead_) {
    must_reach_ = std::max(must_reach_, request.segment + 1);
  } else {
    plan_from(request.segment);
  }
}

/// The segment, and those that follow it and are wanted, up to what one request computes.
void Leader::plan_from(Id segment) {
  Plan plan;
  const Id count = std::min(parameters_.segments_per_request, segments_that_fit());
  const Id end = static_cast<Id>(std::min<Offset>(mesh_.segments(), Offset(segment) + count));
  plan.alone = workers_.front()->is_large(segment);
  for (Id s = segment; s < end; ++s) {
    if (s != segment && (plan.alone || workers_.front()->is_large(s))) break;
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
  while (ahead_ < mesh_.segments() && !is_wanted(ahead_)) ++ahead_;
  if (ahead_ == mesh_.segments()) return false;
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
  bool large = false;
  for (; ahead_ < mesh_.segments() && plan.segments.size() < count && !large; ++ahead_) {
    if (!is_wanted(ahead_)) continue;
    large = workers_.front()->is_large(ahead_);
    if (large && !plan.segments.empty()) break;
    under_way_[ahead_] = true;
    plan.segments.push_back(ahead_);
  }
  ahead_batch_ = static_cast<Id>(std::min<Offset>(Offset(ahead_batch_) * 2, mesh_.segments()));
  return plan;
}

void Leader::launch(Plan plan, Arena& arena) {
  BatchWorker* const worker = idle_.back();
  try {
    worker->launch(plan.segments, static_cast<Offset>(arena.words.size()), plan.scratch);
  } catch (...) {
    worker->abandon();
    const bool is_too_big = is_out_of_memory();
    if (is_too_big && plan.segments.size() == 1 && launch_on_host(plan, arena)) return;
    store_.give_back(arena);
    if (!is_too_big || plan.segments.size() == 1) throw;
    split(std::move(plan));
    return;
  }
  idle_.pop_back();
  flights_.push_back({std::move(plan), worker, nullptr, &arena, Clock::now(), false});
}

/// For a segment that the device has no memory for; false if the leader has nobody on the host.
bool Leader::launch_on_host(const Plan& plan, Arena& arena) {
  if (!parameters_.make_host_worker) return false;
  const std::shared_ptr<BatchWorker> worker = parameters_.make_host_worker();
  worker->launch(plan.segments, static_cast<Offset>(arena.words.size()), plan.scratch);
  flights_.push_back({plan, worker.get(), worker, &arena, Clock::now(), false});
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.segments_on_host;
  return true;
}

/// A flight's worker has nothing to do.
void Leader::release(const Flight& flight) {
  if (!flight.on_host) idle_.push_back(flight.worker);
}

/// Tries the plan in two parts, if it has more than one segment; before all other plans.
void Leader::split(Plan plan) {
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.batches_split;
  plan.alone = true;
  Plan second = plan;
  const auto half = plan.segments.begin() + static_cast<std::ptrdiff_t>((plan.segments.size() + 1) / 2);
  second.segments.assign(half, plan.segments.end());
  plan.segments.erase(half, plan.segments.end());
  if (!second.segments.empty()) plans_.push_front(std::move(second));
  plans_.push_front(std::move(plan));
}

void Leader::begin_copy(Flight& flight) {
  if (!flight.copying) flight.worker->begin_copy(*flight.arena);
  flight.copying = true;
}

void Leader::finish_oldest() {
  // The next copy begins before this one's blocks are published, so that the link never rests.
  for (std::size_t i = 0; i < std::min<std::size_t>(flights_.size(), 2); ++i) begin_copy(flights_[i]);
  const Shortfall shortfall = flights_.front().worker->finish(*flights_.front().arena);
  const auto finished = Clock::now();
  const Flight flight = std::move(flights_.front());
  flights_.pop_front();
  release(flight);
  Plan made, missing = flight.plan;
  missing.segments.clear();
  const std::size_t relations = parameters_.relations.count();
  for (std::size_t slot = 0; slot < flight.plan.segments.size(); ++slot) {
    const bool there = flight.arena->directory[slot * relations] != BlockPool::missing;
    (there ? made : missing).segments.push_back(flight.plan.segments[slot]);
  }
  account(made, shortfall, flight.plan.segments.size());
  if (made.segments.empty()) {
    store_.give_back(*flight.arena);
  } else {
    store_.publish(*flight.arena, sweeping_ && flight.plan.ahead ? static_cast<Id>(made.segments.size()) : 0);
    deliver(made, flight.launched, finished);
  }
  if (!missing.segments.empty()) retry(std::move(missing), shortfall);
}

void Leader::account(const Plan& made, const Shortfall& shortfall, std::size_t launched) {
  std::int64_t again = 0;
  for (const Id segment : made.segments) {
    again += computed_[segment] ? 1 : 0;
    computed_[segment] = true;
    under_way_[segment] = false;
  }
  const double words = static_cast<double>(shortfall.words) / static_cast<double>(launched);
  words_per_segment_ = std::max(words, 0.75 * words_per_segment_ + 0.25 * words);
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.batches;
  statistics_.segments_computed += static_cast<std::int64_t>(made.segments.size());
  statistics_.segments_recomputed += again;
  statistics_.bytes += shortfall.words * static_cast<Offset>(sizeof(Id));
  statistics_.blocks_evicted = store_.evicted();
}

/// Tries what didn't fit again: with the scratch memory that it needs, and fewer segments at a time or, for one, more
/// room.
void Leader::retry(Plan plan, const Shortfall& shortfall) {
  plan.scratch = larger(plan.scratch, shortfall.scratch);
  if (plan.segments.size() == 1) plan.words = std::max(plan.words, shortfall.words);
  split(std::move(plan));
}

/// Gives the blocks to those who wait for them.
void Leader::deliver(const Plan& plan, Clock::time_point launched, Clock::time_point finished) {
  for (const Id segment : plan.segments) {
    if (waiting_.empty()) return;
    const auto range = waiting_.equal_range(segment);
    for (auto it = range.first; it != range.second; ++it) {
      it->second->launched = std::max(launched, it->second->taken);
      it->second->finished = std::max(finished, it->second->launched);
      it->second->fulfil(store_.find(segment));
    }
    waiting_.erase(range.first, range.second);
  }
}

void Leader::fail_all(const std::string& why) {
  for (const auto& flight : flights_) {
    flight.worker->abandon();
    store_.give_back(*flight.arena);
    release(flight);
  }
  flights_.clear();
  plans_.clear();
  std::fill(under_way_.begin(), under_way_.end(), false);
  for (const auto& waiter : waiting_) waiter.second->fail(why);
  waiting_.clear();
}

LeaderStatistics Leader::statistics() const {
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  return statistics_;
}

std::size_t Leader::device_bytes() const {
  std::size_t bytes = 0;
  for (const auto& worker : workers_) bytes += worker->device_bytes();
  return bytes;
}

}  // namespace gale::detail
