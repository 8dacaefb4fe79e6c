#pragma once

#include <functional>

#include <gale/base/threads.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// How to go through a mesh segment by segment.
struct SweepOptions {
  int threads = host_threads();  ///< consumers; at least 1

  /// Told now and then, by one of the consumers, how many segments are done.
  std::function<void(Id done, Id segments)> progress;
};

/// What a sweep calls with a consumer's number, in 0..threads-1, and the rows of a segment, which are valid during the
/// call. Different consumers call it at the same time.
using SegmentBody = std::function<void(int consumer, const SegmentRows& rows)>;

}  // namespace gale
