#pragma once

#include <cstddef>

namespace gale {

/// Who computes the relations of a segment.
enum class Way {
  automatic,      ///< leaders where Kokkos has a device, else helpers
  leaders,        ///< one leader thread a queue, which has batches computed in the workers' space, ahead of need
  inline_,        ///< each consumer for itself, on the host: nothing is handed over and nobody waits
  helpers,        ///< inline, and in a sweep cores without a consumer compute ahead of those; nobody waits for another
  task_parallel,  ///< on the host, a worker thread for each consumer of a sweep, which runs ahead of it, as in ACTOPO
};

/// One queue, and one leader with it, for what?
enum class Queues {
  per_kernel,   ///< relations that one kernel computes together share one
  per_relation  ///< each relation has its own, as in the paper
};

/// How a `Runtime` works. 0 stands for a default that suits the backend; none of them changes a result.
struct RuntimeOptions {
  Way way = Way::automatic;
  Queues queues = Queues::per_kernel;

  /// The paper's n_b, t_b and t_s: for each request, n_b * t_b / t_s segments are computed, the one asked for and those
  /// that follow; a segment by t_s threads, rounded up to whole warps.
  int blocks_per_request = 0;
  int threads_per_block = 0;
  int threads_per_segment = 0;

  /// Bytes for blocks that are kept on the host, for all queues or helpers together; by default an eighth of the
  /// machine's memory. Exceeded only by what consumers hold at one time, and by a block of each helper; helpers that it
  /// is too small for don't help.
  std::size_t host_memory = 0;

  /// Without leaders, how many cores a sweep's consumers and helpers share: with as many consumers there is no helper.
  /// By default all that the thread which begins the sweep may run on.
  int cores = 0;

  /// Bytes for batches on the device, for all queues together; by default three of 16 MiB each a queue.
  std::size_t device_memory = 0;
};

}  // namespace gale
