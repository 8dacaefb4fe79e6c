#include <sys/resource.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gale/app/machine.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>

namespace gale::app {

namespace {

std::atomic<std::int64_t> device_bytes{0};
std::atomic<std::int64_t> device_peak{0};

bool is_on_device(const Kokkos::Tools::SpaceHandle& space) {
  return have_device && std::strcmp(space.name, WorkerMemory::name()) == 0;
}

void on_allocation(Kokkos::Tools::SpaceHandle space, const char*, const void*, std::uint64_t bytes) {
  if (!is_on_device(space)) return;
  const std::int64_t now = device_bytes += static_cast<std::int64_t>(bytes);
  std::int64_t peak = device_peak;
  while (peak < now && !device_peak.compare_exchange_weak(peak, now)) {
  }
}

void on_deallocation(Kokkos::Tools::SpaceHandle space, const char*, const void*, std::uint64_t bytes) {
  if (is_on_device(space)) device_bytes -= static_cast<std::int64_t>(bytes);
}

/// Runs that on a mesh with as few points along an axis as give every kind of critical simplex.
void run_on_tiny_mesh(const std::function<void(const VertexOrder&)>& run) {
  prepare_copies(host_threads());
  const ThreadLimit alone(1);  // the others read
  const io::Dataset data = io::make_grid(12);
  const auto& values = std::get<std::vector<float>>(data.arrays.front().values);
  const Mesh mesh = make_mesh(std::get<io::Dataset::Points<float>>(data.points), data.tetrahedra);
  if (mesh.on_device()) run(VertexOrder(mesh, values.data(), values.size()));
}

}  // namespace

std::int64_t host_peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

double process_age() {
  std::ifstream stat("/proc/self/stat");
  std::string text;
  std::getline(stat, text);
  std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size())));  // behind its name
  constexpr int place_of_start = 20;
  double ticks = 0;
  for (int place = 0; place < place_of_start && rest >> text; ++place) ticks = std::atof(text.c_str());
  timespec now{};
  if (ticks <= 0 || clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0;
  const double age = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
                     ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  return std::max(age, 0.0);
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::optional<std::int64_t> device_peak_bytes() {
  if (!have_device) return std::nullopt;
  return device_peak.load();
}

void watch_device_memory() {
  // A Kokkos Tool that the user has loaded needs these callbacks for itself.
  if (!have_device || Kokkos::Tools::profileLibraryLoaded()) return;
  Kokkos::Tools::Experimental::set_allocate_data_callback(on_allocation);
  Kokkos::Tools::Experimental::set_deallocate_data_callback(on_deallocation);
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int most = 1 << 30, most_of_older_ones = 1 << 25;  // these refuse more
  if (mallopt(M_MMAP_THRESHOLD, most) == 0 && mallopt(M_MMAP_THRESHOLD, most_of_older_ones) == 0) return;
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

void require_threads(int count) {
  std::mutex mutex;
  std::condition_variable all_begun;
  bool is_over = false;
  std::vector<std::thread> threads;
  std::exception_ptr failure;
  try {
    threads.reserve(count);
    for (int i = 1; i < count; ++i) {
      threads.push_back(detail::start_thread([&] {
        std::unique_lock<std::mutex> lock(mutex);
        all_begun.wait(lock, [&] { return is_over; });
      }));
    }
  } catch (...) {
    failure = std::current_exception();
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
  }
  all_begun.notify_all();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

void WarmUp::begin(std::function<void(const VertexOrder&)> run) {
  if (!have_device) return;
  thread_ = detail::start_thread([run = std::move(run)] {
    try {
      run_on_tiny_mesh(run);
    } catch (...) {
      // The work meets the same, and says it.
    }
  });
}

void WarmUp::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace gale::app
