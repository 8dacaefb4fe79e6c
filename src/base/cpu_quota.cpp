#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include <gale/base/cpu_quota.hpp>

#if defined(__linux__)
#include <sched.h>
#endif

namespace gale::detail {

namespace {

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

int cpus_of_quota(const std::string& quota, const std::string& period) {
  std::int64_t allowed = 0, of = 0;
  if (!(std::istringstream(quota) >> allowed) || !(std::istringstream(period) >> of)) return 0;
  if (allowed <= 0 || of <= 0) return 0;
  const std::int64_t cpus = (allowed - 1) / of + 1;
  return static_cast<int>(std::min<std::int64_t>(cpus, std::numeric_limits<int>::max()));
}

int cpus_of_quota(const std::string& cpu_max) {
  std::istringstream words(cpu_max);
  std::string quota, period;
  words >> quota >> period;
  return cpus_of_quota(quota, period);
}

int cpu_quota() {
  const int cpus = cpus_of_quota(text_of("/sys/fs/cgroup/cpu.max"));
  if (cpus > 0) return cpus;
  return cpus_of_quota(text_of("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"), text_of("/sys/fs/cgroup/cpu/cpu.cfs_period_us"));
}

int available_cores() {
  int cores = cores_of_affinity();
  if (cores < 1) cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores < 1) return 1;
  const int quota = cpu_quota();
  return quota > 0 ? std::min(cores, quota) : cores;
}

}  // namespace gale::detail
