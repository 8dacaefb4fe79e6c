#include <chrono>
#include <thread>

#include <gale/base/stop.hpp>

namespace gale {

namespace {

thread_local const StopRequest* request_here = nullptr;

/// Whether this thread may stop: no other rank would wait for it.
thread_local bool can_stop = true;

}  // namespace

StopScope::StopScope(const StopRequest* request) : before_(request_here), could_stop_(can_stop) {
  request_here = request;
  can_stop = true;
}
StopScope::~StopScope() {
  request_here = before_;
  can_stop = could_stop_;
}

void detail::await_ranks() { can_stop = false; }

detail::StopsHere::StopsHere() : could_stop_(can_stop) { can_stop = true; }
detail::StopsHere::~StopsHere() { can_stop = could_stop_; }

const StopRequest* detail::stop_request() { return can_stop ? request_here : nullptr; }

void detail::stop_if_asked() {
  if (can_stop && request_here != nullptr && request_here->is_made()) throw Stopped();
}

std::unique_lock<std::mutex> detail::lock_or_stop(std::mutex& mutex) {
  if (stop_request() == nullptr) return std::unique_lock<std::mutex>(mutex);
  std::unique_lock<std::mutex> lock(mutex, std::defer_lock);
  while (!lock.try_lock()) {
    stop_if_asked();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return lock;
}

}  // namespace gale
