#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>

#include <gale/runtime/sweep_options.hpp>

// Kokkos and this process: it is initialized by the first call, unless somebody else did that, and finalized at exit.

namespace gale::python {

/// What lives no longer than Kokkos does: e.g. a mesh, which has Views.
class Kept {
 public:
  Kept();
  virtual ~Kept();
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  /// To be forgotten when Kokkos ends, though Python may still have it.
  virtual void end() = 0;
};

/// At exit. Ends what is kept, then Kokkos if it was initialized here; does neither while another thread is in a
/// `Call`.
void finalize();

/// In a process that was forked from this one: if GALE was used before, its threads aren't there.
void after_fork();

/// One call into GALE, without Python's lock; the first one initializes Kokkos. Throws gale::Error after finalize, and
/// after_fork where Kokkos was initialized before.
class Call {
 public:
  Call();
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  struct Entered {
    Entered();
    ~Entered();
  };

  Entered entered_;
  nanobind::gil_scoped_release released_;
};

/// Sweeps on so many threads, or as many as there are cores for 0; an interrupt (Ctrl-C) ends them, and `progress`, if
/// it isn't None, is called with how much is done, of how much.
SweepOptions sweep_options(int threads, const nanobind::object& progress);

}  // namespace gale::python
