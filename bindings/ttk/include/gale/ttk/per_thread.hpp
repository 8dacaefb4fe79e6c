#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>

namespace gale::ttk {

namespace detail {

/// Numbers that no two objects of a program share, also if one is gone when the other is made.
inline std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace detail

/// A `State` for each thread that asks, all gone with this object. A thread finds the one that it asked for last in
/// some ns, by the object's number: an address may be another object's by then. That of a thread that has ended is the
/// next one's with its id.
template <class State>
class PerThread {
 public:
  PerThread() : number_(detail::next_number()) {}

  std::uint64_t number() const { return number_; }

  /// The calling thread's; make() returns a new one, as a unique_ptr.
  template <class Make>
  State& here(const Make& make) {
    static thread_local Last last = {0, nullptr};
    if (last.number != number_) last = {number_, &find(make)};
    return *last.state;
  }

 private:
  struct Last {
    std::uint64_t number;
    State* state;
  };

  template <class Make>
  __attribute__((noinline)) State& find(const Make& make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto& state = states_[std::this_thread::get_id()];
    if (!state) state = make();
    return *state;
  }

  const std::uint64_t number_;
  std::mutex mutex_;
  std::unordered_map<std::thread::id, std::unique_ptr<State>> states_;
};

}  // namespace gale::ttk
