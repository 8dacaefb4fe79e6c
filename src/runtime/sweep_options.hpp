#pragma once

#include <cstddef>
#include <functional>

#include <gale/base/threads.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// How to go through a mesh segment by segment.
struct SweepOptions {
  int threads = host_threads();  ///< consumers; 1 to most_threads

  /// Told now and then, by one of the consumers, how many segments are done; where kernels compute, at their end alone.
  std::function<void(Id done, Id segments)> progress;
};

/// What a sweep calls with a consumer's number, in 0..threads-1, and the rows of a segment, which are valid during the
/// call. Different consumers call it at the same time.
using SegmentBody = std::function<void(int consumer, const SegmentRows& rows)>;

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
