#include "process.hpp"

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include <gale/base/error.hpp>

#include "initialize_kokkos.hpp"
#include "job.hpp"

namespace gale::python {

namespace {

enum class Phase { running, ended, forked };

std::atomic<Phase> phase{Phase::running};
std::thread::id ending_thread;  // set before the phase
bool initialized_here = false;  // guarded by Python's lock

std::mutex kept_mutex;

std::set<Kept*>& all_kept() {
  static std::set<Kept*> all;
  return all;
}

bool is_left_behind() { return phase.load() == Phase::ended && std::this_thread::get_id() != ending_thread; }

[[noreturn]] void wait_for_the_end() {
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
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
  if (phase.load() != Phase::running) return;
  ending_thread = std::this_thread::get_id();
  phase.store(Phase::ended);
  {
    const nanobind::gil_scoped_release released;  // which others need to end what they do
    constexpr std::chrono::seconds most(5);
    if (!stop_jobs(most)) return;
  }
  end_workers();
  const std::lock_guard<std::mutex> lock(kept_mutex);
  for (Kept* const one : all_kept()) one->end();
  if (initialized_here) Kokkos::finalize();
}

void after_fork() {
  if (Kokkos::is_initialized()) phase.store(Phase::forked);
}

void begin_call() {
  if (is_left_behind()) {
    const nanobind::gil_scoped_release released;
    wait_for_the_end();
  }
  if (phase.load() == Phase::forked)
    throw Error("gale can't be used in a process that was forked from one that uses it: start processes by 'spawn'");
  if (phase.load() == Phase::ended) throw Error("gale has ended with the interpreter");
  if (bindings::initialize_kokkos()) initialized_here = true;
}

void end_call() {
  if (is_left_behind()) wait_for_the_end();
}

}  // namespace gale::python
