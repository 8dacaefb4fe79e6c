#include <gale/base/threads.hpp>
#include <gale/runtime/helpers/helped_sweep.hpp>

#ifdef __linux__
#include <unistd.h>
#endif

#include <chrono>

namespace gale::detail {

namespace {

/// The nap of a helper whose ring is full. Nobody wakes it, which would cost consumers more than a helper that looks
/// now and then costs its core.
constexpr std::chrono::microseconds nap(20);

/// Has the calling thread give way to consumers where cores aren't as idle as they seem: other programs may use them,
/// and then it must not share a consumer's.
void give_way() {
#ifdef __linux__  // where it is for the thread alone
  constexpr int much = 10;
  [[maybe_unused]] const int is_now = nice(much);  // may fail: then it competes
#endif
}

}  // namespace

Helper::Helper(const MakeWorker& make, UnbegunSegments& unbegun, std::size_t budget)
    : thread_(start_thread([this, make, &unbegun, budget] {
        try {
          run(make, unbegun, budget);
        } catch (...) {  // its segment is still under way, for a consumer to take away
        }
      })) {}

Helper::~Helper() {
  stopping_ = true;
  end();
}

void Helper::end() {
  if (thread_.joinable()) thread_.join();
}

void Helper::run(const MakeWorker& make, UnbegunSegments& unbegun, std::size_t budget) {
  give_way();
  worker_ = make(statistics_, slots);
  for (std::uint64_t filled = 0;; filled_ = ++filled) {
    block_bytes_ = worker_->block_bytes();
    const int slot = static_cast<int>(filled % slots);
    if (block_bytes_ > budget || !wait_for_room(slot)) return;
    const Id segment = unbegun.take();
    if (segment == no_id) return;
    under_way_ = segment;
    free_.fetch_and(~(1u << slot));
    rows_[slot] = worker_->compute(segment);
    if (under_way_.exchange(no_id) == no_id) return;  // taken away: no others are left
  }
}

bool Helper::wait_for_room(int slot) const {
  while (!stopping_) {
    if (free_ >> slot & 1u) return true;
    std::this_thread::sleep_for(nap);
  }
  return false;
}

}  // namespace gale::detail
