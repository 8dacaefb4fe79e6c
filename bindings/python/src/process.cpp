#include "process.hpp"

#include <gale/base/error.hpp>

#include "initialize_kokkos.hpp"

namespace gale::python {

namespace {

enum class Phase { running, ended, forked };

std::atomic<Phase> phase{Phase::running};
std::atomic<int> calls{0};
bool initialized_here = false;  // guarded by Python's lock

std::mutex kept_mutex;

std::set<Kept*>& all_kept() {
  static std::set<Kept*> all;
  return all;
}

}  // namespace

Kept::Kept() {
  const std::lock_guard<std::mutex> lock(kept_mutex);
  all_kept().insert(this);
}

Kept::~Kept() {
  const std::lock_guard<std::mutex> lock(kept_mutex);
  all_kept().erase(this);
}

void finalize() {
  if (phase.load() != Phase::running || calls.load() > 0) return;
  phase.store(Phase::ended);
  const std::lock_guard<std::mutex> lock(kept_mutex);
  for (Kept* const one : all_kept()) one->end();
  if (initialized_here) Kokkos::finalize();
}

void after_fork() {
  if (Kokkos::is_initialized()) phase.store(Phase::forked);
}

Call::Entered::Entered() {
  if (phase.load() == Phase::forked)
    throw Error("gale can't be used in a process that was forked from one that uses it: start processes by 'spawn'");
  if (phase.load() == Phase::ended) throw Error("gale has ended with the interpreter");
  if (bindings::initialize_kokkos()) initialized_here = true;
  ++calls;
}

Call::Entered::~Entered() { --calls; }

Call::Call() = default;
Call::~Call() = default;

SweepOptions sweep_options(int threads, const nanobind::object& progress) {
  if (threads < 0) throw Error("threads is " + std::to_string(threads));
  SweepOptions options;
  if (threads > 0) options.threads = threads;
  const nanobind::handle tell = progress;  // the caller holds it
  options.progress = [tell](Id done, Id segments) {
    const nanobind::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    if (!tell.is_none()) tell(done, segments);
  };
  return options;
}

}  // namespace gale::python
