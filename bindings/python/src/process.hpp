#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>

#include <gale/runtime/sweep_options.hpp>

// Kokkos and this process: it is initialized when the module is imported, and finalized at exit.

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

void initialize();

/// At exit. Ends what is kept, then Kokkos; does neither while another thread is in a `Call`.
void finalize();

/// In a process that was forked from one that uses GALE: its threads aren't there.
void after_fork();

/// One call into GALE, without Python's lock. Throws gale::Error after finalize and after_fork.
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
