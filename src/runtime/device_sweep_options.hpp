#pragma once

#include <cstddef>

namespace gale {

/// How a sweep whose consumers are kernels goes through a mesh. 0 stands for a default; no result depends on them.
struct DeviceSweepOptions {
  /// Bytes for blocks, of all batches that are under way together. Exceeded only where one segment takes more. By
  /// default 96 MiB on a device, 4 MiB on the host.
  std::size_t memory = 0;

  int batches = 0;              ///< under way at a time; by default 3 on a device, 1 on the host
  int threads_per_segment = 0;  ///< threads of the teams that make rows; by default 128

  /// Threads of the teams that read rows, rounded up to whole warps; by default one a row up to 256, or 256 in
  /// for_each_row. On the host a team is one thread; on HostThreads nothing else of these options is taken notice of.
  int threads_per_team = 0;

  /// Bytes of scratch memory, at level 0, that the functor has in each of these teams.
  std::size_t team_scratch = 0;
};

}  // namespace gale
