#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

#include <gale/base/kokkos.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>

namespace gale {

namespace detail {

/// Something that happens once, by whichever thread comes first; the others wait for it. If it throws, the next one
/// tries again (std::call_once should do that, but doesn't on every platform).
class Once {
 public:
  template <class Action>
  void operator()(const Action& action) {
    if (done_.load(std::memory_order_acquire)) return;
    const auto lock = lock_or_stop(mutex_);
    if (done_.load(std::memory_order_relaxed)) return;
    const TrackedViews tracked;  // what is made here lasts, also where it is asked for in a sweep's body
    action();
    done_.store(true, std::memory_order_release);
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> done_{false};
};

/// A value that the first caller of get() makes, on any thread. Other threads wait for it.
template <class T>
class OnceMade {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    once_([&] { value_ = make(); });
    return value_;
  }

 private:
  mutable Once once_;
  mutable T value_{};
};

/// A Mirrored where the workers' memory is the host's: the array.
template <class T>
class OneArray {
 public:
  OneArray() = default;
  explicit OneArray(const Array<const T, HostMemory>& array) : array_(array) {}

  template <class Memory>
  const Array<const T, Memory>& in() const {
    return array_;
  }
  void bring_to_host() const {}
  bool on_device() const { return false; }
  std::size_t size() const { return array_.extent(0); }

 private:
  Array<const T, HostMemory> array_;
};

/// A Mirrored where there are two memories.
template <class T>
class TwoArrays {
 public:
  TwoArrays() : TwoArrays(Array<const T, HostMemory>()) {}
  template <class Memory>
  explicit TwoArrays(const Kokkos::View<const T*, Memory>& array) : arrays_(std::make_shared<Arrays>()) {
    if constexpr (is_device_memory<Memory>) {
      arrays_->worker = array;
      arrays_->on_device = true;
    } else {
      arrays_->host = array;
    }
  }

  template <class Memory>
  const Array<const T, Memory>& in() const {
    if (arrays_->on_device != is_device_memory<Memory>) arrays_->copy();
    if constexpr (is_device_memory<Memory>) {
      return arrays_->worker;
    } else {
      return arrays_->host;
    }
  }
  void bring_to_host() const { arrays_->bring_to_host(); }
  bool on_device() const { return arrays_->on_device; }
  std::size_t size() const { return on_device() ? arrays_->worker.extent(0) : arrays_->host.extent(0); }

 private:
  struct Arrays {
    Array<const T, WorkerMemory> worker;
    Array<const T, HostMemory> host;
    bool on_device = false;  ///< where it was made, and is complete from the beginning
    Once copied, begun;
    std::thread bringing;

    ~Arrays() {
      if (bringing.joinable()) bringing.join();
    }

    void copy() {
      copied([this] {
        if (on_device) {
          host = on_host(worker);
        } else {
          worker = on_worker(host);
        }
      });
    }

    void bring_to_host() {
      if (!on_device) return;
      begun([this] {
        try {
          bringing = start_thread([this] { copy_on_a_thread(); });
        } catch (const std::exception&) {  // there are no more threads: who asks for the copy makes it
        }
      });
    }

    void copy_on_a_thread() {
      try {
        copied([this] {
          const auto there = allocate<Array<T, HostMemory>>(worker.label(), worker.extent(0));
          copy_meanwhile(there.data(), worker.data(), worker.extent(0) * sizeof(T));
          host = there;
        });
      } catch (const std::exception&) {
        // Who asks for the copy tries again, and hears of it.
      }
    }
  };

  std::shared_ptr<Arrays> arrays_;
};

}  // namespace detail

/// An array that was made in the workers' memory, or in the host's where it did not fit, and that either side reads.
/// Copies share it. What it was made from must not be written any more.
template <class T>
class Mirrored {
  template <class View>
  using MemoryOfView = std::conditional_t<is_device_memory<typename View::memory_space>, WorkerMemory, HostMemory>;
  using Arrays = std::conditional_t<have_device, detail::TwoArrays<T>, detail::OneArray<T>>;

 public:
  /// An array without entries.
  Mirrored() = default;

  /// An array that lies in a View of T or const T of rank 1, in the workers' memory or the host's.
  template <class View, class = std::enable_if_t<std::is_same_v<typename View::non_const_value_type, T>>>
  Mirrored(const View& array) : arrays_(Array<const T, MemoryOfView<View>>(array)) {}

  /// The entries, for code that runs on `Memory`. The first call for a memory that it was not made in copies it there:
  /// any thread may make it; the others wait. After that, and where it was made, a call takes no lock. Throws
  /// OutOfMemory if the copy doesn't fit; a later call tries again.
  template <class Memory>
  const Array<const T, Memory>& in() const {
    return arrays_.template in<Memory>();
  }

  /// Begins to copy it to the host, on a thread of its own, for those who will ask for it there soon: they wait for
  /// that then. To be called when what made it is done. That thread takes no notice of limits and requests of this one;
  /// the last copy of this, when it is destroyed, waits for it.
  void bring_to_host() const { arrays_.bring_to_host(); }

  /// Whether it was made in a device's memory.
  bool on_device() const { return arrays_.on_device(); }

  /// How many entries it has.
  std::size_t size() const { return arrays_.size(); }

 private:
  Arrays arrays_;
};

}  // namespace gale
