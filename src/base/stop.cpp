#include <chrono>
#include <thread>

#include <gale/base/stop.hpp>

namespace gale {

namespace {

thread_local const StopRequest* request_here = nullptr;

}  // namespace

StopScope::StopScope(const StopRequest* request) : before_(request_here) { request_here = request; }
StopScope::~StopScope() { request_here = before_; }

const StopRequest* detail::stop_request() { return request_here; }

void detail::stop_if_asked() {
  if (request_here != nullptr && request_here->is_made()) throw Stopped();
}

std::unique_lock<std::mutex> detail::lock_or_stop(std::mutex& mutex) {
  if (request_here == nullptr) return std::unique_lock<std::mutex>(mutex);
  std::unique_lock<std::mutex> lock(mutex, std::defer_lock);
  while (!lock.try_lock()) {
    stop_if_asked();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return lock;
}

}  // namespace gale
