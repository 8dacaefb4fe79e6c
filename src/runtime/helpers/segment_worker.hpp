#pragma once

#include <functional>
#include <memory>

#include <gale/runtime/inline/inline_structure.hpp>

namespace gale::detail {

/// What consumers and helpers of a sweep compute segments with: a HostWorker that keeps count. Tests put others in its
/// place.
class SegmentWorker {
 public:
  /// Counts in `statistics`, which must outlive it. The blocks of the last `kept` segments stay valid.
  SegmentWorker(const Mesh& mesh, RelationSet relations, ConsumerStatistics& statistics, int kept)
      : worker_(mesh, relations, kept), statistics_(statistics) {}
  virtual ~SegmentWorker() = default;

  virtual SegmentRows compute(Id segment) { return compute_counted(worker_, segment, statistics_); }

  /// Allocated for blocks, now.
  std::size_t block_bytes() const { return worker_.block_bytes(); }

 private:
  HostWorker worker_;
  ConsumerStatistics& statistics_;
};

/// Makes one.
using MakeWorker = std::function<std::unique_ptr<SegmentWorker>(ConsumerStatistics& statistics, int kept)>;

}  // namespace gale::detail
