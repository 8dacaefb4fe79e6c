#pragma once

#include <gale/base/kokkos.hpp>

namespace gale::detail {

/// Sets whether the calling thread counts references to Views, as long as it lives. Kokkos counts without atomics where
/// Serial is its only backend; our own threads share Views there too.
class ViewTracking {
 public:
  explicit ViewTracking(bool on) : was_on_(Record::tracking_enabled() != 0) { set(on); }
  ~ViewTracking() { set(was_on_); }
  ViewTracking(const ViewTracking&) = delete;
  ViewTracking& operator=(const ViewTracking&) = delete;

 private:
  using Record = Kokkos::Impl::SharedAllocationRecord<void, void>;

  static void set(bool on) { on ? Record::tracking_enable() : Record::tracking_disable(); }

  const bool was_on_;
};

/// Copies of Views made meanwhile own nothing.
struct UntrackedViews : ViewTracking {
  UntrackedViews() : ViewTracking(false) {}
};

/// For what is made to last, e.g. the first time that somebody needs it, wherever that is.
struct TrackedViews : ViewTracking {
  TrackedViews() : ViewTracking(true) {}
};

}  // namespace gale::detail
