#pragma once

#include <gale/relations/face_reader.hpp>
#include <gale/runtime/inline/recent_blocks.hpp>
#include <gale/runtime/statistics.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// A consumer that computes what it misses and keeps the blocks of the segments that it read last.
class InlineConsumer : public Consumer {
 public:
  InlineConsumer(const Mesh& mesh, RelationSet relations, std::shared_ptr<ConsumerLog> log);
  ~InlineConsumer() override;

 protected:
  SegmentRows load(RelationSet one, Id simplex) override;

 private:
  const Mesh mesh_;
  const RelationSet relations_;
  FaceReader faces_;
  const std::shared_ptr<ConsumerLog> log_;
  ConsumerStatistics statistics_;
  std::vector<RecentBlocks> blocks_;  ///< by kernel
};

}  // namespace gale::detail
