#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include <gale/base/threads.hpp>

#if defined(__linux__)
#include <sched.h>
#endif

namespace gale {

namespace {

constexpr int no_limit = std::numeric_limits<int>::max();

/// What the application chose; 0 if it chose nothing.
std::atomic<int> chosen_threads{0};

/// The least of the ThreadLimits that live on this thread.
thread_local int limit_here = no_limit;

/// The largest team that this thread has asked for.
thread_local int team_here = 1;

/// The first number of OMP_NUM_THREADS, which may be a list; 0 if it isn't set.
int asked_of_openmp() {
  const char* const text = std::getenv("OMP_NUM_THREADS");
  return text == nullptr ? 0 : std::max(std::atoi(text), 0);
}

int default_threads() {
  static const int cores = detail::available_cores();
  static const int asked = asked_of_openmp();
#ifdef GALE_ENABLE_STD_THREADS
  return asked > 0 ? asked : cores;
#else
  return asked > 0 ? omp_get_max_threads() : std::min(omp_get_max_threads(), cores);
#endif
}

/// The file's text; empty where there is no such file.
std::string text_of(const char* path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Cores of the process's affinity; 0 where the system doesn't say.
int cores_of_affinity() {
#if defined(__linux__)
  constexpr int most = 1 << 16;
  for (int cores = CPU_SETSIZE; cores <= most; cores *= 2) {
    cpu_set_t* const set = CPU_ALLOC(cores);
    if (set == nullptr) return 0;
    const std::size_t bytes = CPU_ALLOC_SIZE(cores);
    const int count = sched_getaffinity(0, bytes, set) == 0 ? CPU_COUNT_S(bytes, set) : 0;
    CPU_FREE(set);
    if (count > 0) return count;
  }
#endif
  return 0;
}

}  // namespace

int detail::cpus_of_quota(const std::string& quota, const std::string& period) {
  std::int64_t allowed = 0, of = 0;
  if (!(std::istringstream(quota) >> allowed) || !(std::istringstream(period) >> of)) return 0;
  if (allowed <= 0 || of <= 0) return 0;
  const std::int64_t cpus = (allowed - 1) / of + 1;
  return static_cast<int>(std::min<std::int64_t>(cpus, std::numeric_limits<int>::max()));
}

int detail::cpus_of_quota(const std::string& cpu_max) {
  std::istringstream words(cpu_max);
  std::string quota, period;
  words >> quota >> period;
  return cpus_of_quota(quota, period);
}

int detail::cpu_quota() {
  const int cpus = cpus_of_quota(text_of("/sys/fs/cgroup/cpu.max"));
  if (cpus > 0) return cpus;
  return cpus_of_quota(text_of("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"), text_of("/sys/fs/cgroup/cpu/cpu.cfs_period_us"));
}

int detail::available_cores() {
  int cores = cores_of_affinity();
  if (cores < 1) cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores < 1) return 1;
  const int quota = cpu_quota();
  return quota > 0 ? std::min(cores, quota) : cores;
}

int host_threads() {
  const int chosen = chosen_threads.load(std::memory_order_relaxed);
  return std::min({chosen > 0 ? chosen : default_threads(), limit_here, most_threads});
}

void detail::require_thread_count(int count) {
  if (count < 1 || count > most_threads)
    throw Error("threads is " + std::to_string(count) + ", not 1 to " + std::to_string(most_threads));
}

int detail::team_for(int count) {
  team_here = std::max(team_here, count);
  return std::max(count, std::min(team_here, host_threads()));
}

void set_host_threads(int count) {
  count = std::clamp(count, 1, most_threads);
  chosen_threads = count;
#ifndef GALE_ENABLE_STD_THREADS
  omp_set_num_threads(count);  // for other users of OpenMP on this thread, such as Kokkos
#endif
}

ThreadLimit::ThreadLimit(int threads) : before_(limit_here) { limit_here = std::min(before_, std::max(threads, 1)); }
ThreadLimit::~ThreadLimit() { limit_here = before_; }

}  // namespace gale
