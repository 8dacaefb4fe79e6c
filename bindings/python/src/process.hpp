#pragma once

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

/// At exit. Stops what other threads compute, ends what is kept, then Kokkos if it was initialized here; does neither
/// if a computation doesn't end.
void finalize();

/// In a process that was forked from this one: if GALE was used before, its threads aren't there.
void after_fork();

/// To be called, with Python's lock, before anything is computed; the first call initializes Kokkos. Throws gale::Error
/// after finalize, and after_fork where Kokkos was initialized before.
void begin_call();

/// To be called, without Python's lock, when it is done. Doesn't return to the threads that finalize leaves behind:
/// Python stops them too, as soon as they need it.
void end_call();

}  // namespace gale::python
