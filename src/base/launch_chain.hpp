#pragma once

#include <algorithm>
#include <utility>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/thread_stack.hpp>

namespace gale::detail {

/// Where a launch goes on from: entries of a list of open ones, with so many steps each.
struct LaunchPart {
  Offset first = 0, end = 0;
  int steps = 0;
};

/// Plans the next launch of a chain: it goes on from what the launches before have left open, or from nothing, if there
/// isn't room for what a step of each thread finds.
template <class Kernel>
struct PlanLaunch {
  Kernel kernel;

  KOKKOS_FUNCTION void operator()(Offset) const {
    LaunchPart& part = kernel.part();
    part.first = part.end;
    const Offset open = kernel.open() - part.first;
    part.steps = open == 0 ? 0 : StepsOfLaunch::in(kernel.room(), open);
    if (part.steps > 0) part.end += open;
  }
};

/// Goes on from the entries of a launch's part, which so many threads share.
template <class Kernel>
struct GoOn {
  Kernel kernel;
  Offset threads;

  KOKKOS_FUNCTION void operator()(Offset thread) const {
    const LaunchPart part = kernel.part();
    for (Offset i = part.first + thread; i < part.end; i += threads) kernel.go_on(i, part.steps);
  }
};

/// How many launches a chain has: of entries that are few, which may soon come to nothing, two at first, and as many
/// again in each chain that goes on from there.
class ChainLength {
 public:
  static constexpr int most = 8;

  explicit ChainLength(Offset entries) : next_(entries < few ? 2 : most) {}

  int next() { return std::exchange(next_, std::min(2 * next_, most)); }

 private:
  static constexpr Offset few = 1 << 12;

  int next_;
};

/// Launches a kernel again and again, each time on what has been left open by then, without waiting in between: the
/// device says how much that is, and for how many steps there is room. A kernel has part(), open(), which is how many
/// entries its list has, room() for so many more, and go_on(entry, steps), which finds StepsOfLaunch::found_in(steps)
/// at most. `open` of the entries are known to be open at first, or about that many. Afterwards all before part().end
/// are done; where there are more, they want room, or another chain.
template <class Kernel>
void launch_chain(const char* label, const WorkerSpace& space, Offset open, const Kernel& kernel,
                  int launches = ChainLength::most) {
  constexpr Offset fewest_threads = 1 << 13, most_threads = 1 << 17;
  const Offset threads = std::clamp(2 * open, fewest_threads, most_threads);
  for (int i = 0; i < launches; ++i) {
    parallel_for("GALE::plan_launch", space, 1, PlanLaunch<Kernel>{kernel});
    parallel_for(label, space, threads, GoOn<Kernel>{kernel, threads});
  }
}

/// Has an array in the workers' memory have at least `size` entries, and keeps the first `used`: twice as many as it
/// had where there is room for that. Throws OutOfMemory.
template <class T>
void make_room(const WorkerSpace& space, const char* label, Array<T, WorkerMemory>& array, Offset used, Offset size) {
  if (size <= static_cast<Offset>(array.extent(0))) return;
  const auto larger = [&] {
    try {
      return allocate<Array<T, WorkerMemory>>(label, std::max(size, 2 * static_cast<Offset>(array.extent(0))));
    } catch (const OutOfMemory&) {
      return allocate<Array<T, WorkerMemory>>(label, size);
    }
  }();
  if (used > 0) Kokkos::deep_copy(space, first_of(larger, used), first_of(array, used));
  space.fence();
  array = larger;
}

/// What launches have counted in a place of their own: waits for them.
template <class Counts>
Counts counted(const WorkerSpace& space, const Array<Counts, WorkerMemory>& counts) {
  Counts here;
  Kokkos::deep_copy(space, Kokkos::View<Counts*, HostMemory, Kokkos::MemoryUnmanaged>(&here, 1), counts);
  space.fence();
  return here;
}

}  // namespace gale::detail
