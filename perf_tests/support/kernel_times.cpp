#include "support/kernel_times.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <vector>

#include <Kokkos_Core.hpp>

#include "support/seconds.hpp"

namespace gale::perf {

namespace {

using Clock = std::chrono::steady_clock;

struct Open {
  std::string label;
  Clock::time_point begin;
  double processor_begin;
};

std::mutex mutex;
std::map<std::string, KernelTimes::Entry> closed;
std::map<std::uint64_t, Open> open;
std::uint64_t next_id = 1;
thread_local Open copy;

void begin_kernel(const char* label, std::uint32_t, std::uint64_t* id) {
  const std::lock_guard<std::mutex> lock(mutex);
  *id = next_id++;
  open[*id] = {label, Clock::now(), processor_seconds()};
}

void add(const Open& one) {
  auto& entry = closed[one.label];
  entry.seconds += std::chrono::duration<double>(Clock::now() - one.begin).count();
  entry.processor_seconds += processor_seconds() - one.processor_begin;
  ++entry.count;
}

void end_kernel(std::uint64_t id) {
  const std::lock_guard<std::mutex> lock(mutex);
  add(open[id]);
  open.erase(id);
}

void begin_copy(Kokkos::Tools::SpaceHandle to, const char* to_label, const void*, Kokkos::Tools::SpaceHandle from,
                const char* from_label, const void*, std::uint64_t) {
  copy = {std::string("copy ") + from.name + " " + from_label + " to " + to.name + " " + to_label, Clock::now(),
          processor_seconds()};
}

void end_copy() {
  const std::lock_guard<std::mutex> lock(mutex);
  add(copy);
}

}  // namespace

KernelTimes::KernelTimes() {
  namespace Tools = Kokkos::Tools::Experimental;
  closed.clear();
  Tools::set_begin_parallel_for_callback(begin_kernel);
  Tools::set_end_parallel_for_callback(end_kernel);
  Tools::set_begin_parallel_scan_callback(begin_kernel);
  Tools::set_end_parallel_scan_callback(end_kernel);
  Tools::set_begin_parallel_reduce_callback(begin_kernel);
  Tools::set_end_parallel_reduce_callback(end_kernel);
  Tools::set_begin_deep_copy_callback(begin_copy);
  Tools::set_end_deep_copy_callback(end_copy);
}

KernelTimes::~KernelTimes() {
  namespace Tools = Kokkos::Tools::Experimental;
  Tools::set_begin_parallel_for_callback(nullptr);
  Tools::set_end_parallel_for_callback(nullptr);
  Tools::set_begin_parallel_scan_callback(nullptr);
  Tools::set_end_parallel_scan_callback(nullptr);
  Tools::set_begin_parallel_reduce_callback(nullptr);
  Tools::set_end_parallel_reduce_callback(nullptr);
  Tools::set_begin_deep_copy_callback(nullptr);
  Tools::set_end_deep_copy_callback(nullptr);
}

std::map<std::string, KernelTimes::Entry> KernelTimes::entries() const {
  const std::lock_guard<std::mutex> lock(mutex);
  return closed;
}

void KernelTimes::print() const {
  const auto all = entries();
  std::vector<std::pair<std::string, Entry>> sorted(all.begin(), all.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
  std::printf("   by clock   processors   count\n");
  for (const auto& [label, entry] : sorted) {
    std::printf("%8.3f ms  %8.3f ms %7ld  %s\n", 1000 * entry.seconds, 1000 * entry.processor_seconds, entry.count,
                label.c_str());
  }
}

}  // namespace gale::perf
