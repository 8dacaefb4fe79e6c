#pragma once

#include <algorithm>
#include <mutex>

namespace gale::detail {

/// The cores that a sweep takes for helpers since it leaves them idle, as long as this lives. Sweeps that run at once,
/// also of other structures, share them.
class IdleCores {
 public:
  /// Takes `cores` cores, of which the sweep's consumers use some, and for helpers at most `at_most`.
  IdleCores(int cores, int consumers, int at_most) {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = std::clamp(cores - in_use_ - consumers, 0, std::max(at_most, 0));
    claimed_ = consumers + count_;
    in_use_ += claimed_;
  }
  ~IdleCores() {
    const std::lock_guard<std::mutex> lock(mutex_);
    in_use_ -= claimed_;
  }
  IdleCores(const IdleCores&) = delete;
  IdleCores& operator=(const IdleCores&) = delete;

  int count() const { return count_; }

 private:
  inline static std::mutex mutex_;
  inline static int in_use_ = 0;
  int count_, claimed_;
};

}  // namespace gale::detail
