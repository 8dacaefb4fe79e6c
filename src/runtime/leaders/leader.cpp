#include <algorithm>
#include <new>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/leaders/leader.hpp>

namespace gale::detail {

namespace {

/// Batches of a sweep begin small, so that consumers can begin, and double.
constexpr Id first_batch = 32;

/// What the exception that is being handled says.
std::string current_message() {
  try {
    throw;
  } catch (const std::exception& error) {
    return std::string(error.what()) + (Leader::is_out_of_memory() ? ", for one segment" : "");
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
  statistics_.relations = parameters.relations;
  thread_ = start_thread([this] { run(); });
}

Leader::~Leader() { end(); }

/// What a sweep runs through again and again, so that its memory is there, locked, and soon in the caches; less where
/// the blocks of all segments take less. Locking it takes as long as a small sweep: not before a request.
void Leader::prepare_arenas() {
  if (prepared_) return;
  prepared_ = true;
  constexpr std::size_t most = 12;
  const std::size_t bytes = static_cast<std::size_t>(parameters_.arena_words) * sizeof(Id);
  if (bytes == 0) return;
  store_.limit_ahead(most * bytes);
  const double all = 1.2 * words_per_segment_ * mesh_.segments() / static_cast<double>(parameters_.arena_words);
  const std::size_t count = std::min({most, parameters_.host_budget / bytes, static_cast<std::size_t>(all) + 1});
  if (!have_device || count == 0) return;
  try {
    store_.prepare(count, parameters_.arena_words);
  } catch (const OutOfMemory&) {
    // Each batch takes what it needs.
  }
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
    prepare_arenas();
    sweeping_ = true;
    ahead_ = mesh_.owned_segments().first;
    must_reach_ = 0;
    ahead_batch_ = first_batch;
  }
  // First all of them where a failure finds them; after that, a ticket may be fulfilled with another's.
  for (const auto& request : news.requests) {
    request.ticket->taken = request.ticket->launched = request.ticket->finished = now;
    waiting_.emplace(request.segment, request.ticket);
  }
  if (!news.requests.empty()) {
    const std::lock_guard<std::mutex> lock(statistics_mutex_);
    statistics_.queue_lengths.add(news.requests.size());
  }
  for (const auto& request : news.requests) serve(request, now);
}

void Leader::serve(const Request& request, Clock::time_point taken) {
  if (store_.is_resident(request.segment)) {
    deliver({request.segment}, taken, taken);
    return;
  }
  if (under_way_[request.segment]) return;
  if (request.in_sweep && sweeping_ && request.segment >= ahead_) {
    must_reach_ = std::max(must_reach_, request.segment + 1);
  } else {
    plan_from(request.segment);
  }
}

/// Gives the blocks to those who wait for them.
void Leader::deliver(const std::vector<Id>& segments, Clock::time_point launched, Clock::time_point finished) {
  for (const Id segment : segments) {
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
