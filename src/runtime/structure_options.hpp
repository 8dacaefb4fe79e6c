#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <gale/export.hpp>

namespace gale {

/// The ways to compute relations, each a `Structure`. All give the same results.
enum class Way {
  gale,      ///< leaders where the mesh is on a device, else helpers
  leaders,   ///< one leader thread a queue, which has batches computed in the workers' space, ahead of need
  helpers,   ///< inline, and in a sweep cores without a consumer compute ahead of those; nobody waits for another
  inline_,   ///< each consumer computes what it misses, on the host: nothing is handed over and nobody waits
  explicit_  ///< everything at once, kept on the host (`GALE_ENABLE_KOKKOS_KERNELS`)
};

/// "gale", "leaders", "helpers", "inline" or "explicit": its name in the command and in reports.
GALE_EXPORT const char* name_of(Way way);

/// The way of a name; nothing for any other.
GALE_EXPORT std::optional<Way> way_named(const std::string& name);

/// One queue, and one leader with it, for what?
enum class Queues {
  per_kernel,   ///< relations that one kernel computes together share one
  per_relation  ///< each relation has its own, as in the paper
};

/// How a structure works. 0 stands for a default that suits the backend; none of them changes a result.
struct StructureOptions {
  Way way = Way::gale;                 ///< how rows are computed
  Queues queues = Queues::per_kernel;  ///< for leaders: what shares a queue

  /// The paper's n_b: for each request, n_b * t_b / t_s segments are computed, the one asked for and those that follow.
  int blocks_per_request = 0;
  int threads_per_block = 0;    ///< the paper's t_b
  int threads_per_segment = 0;  ///< the paper's t_s: threads that compute a segment, rounded up to whole warps

  /// Bytes for blocks that are kept on the host, for all queues or helpers together; by default an eighth of the
  /// machine's memory. Exceeded only by what consumers hold at one time, and by a block of each helper; helpers that it
  /// is too small for don't help.
  std::size_t host_memory = 0;

  /// For helpers: how many cores a sweep's consumers and helpers share. With as many consumers there is no helper. By
  /// default as many as host_threads() says, which a ThreadLimit bounds.
  int cores = 0;

  /// Bytes for batches on the device, for all queues together; by default three of 16 MiB each a queue.
  std::size_t device_memory = 0;
};

}  // namespace gale
