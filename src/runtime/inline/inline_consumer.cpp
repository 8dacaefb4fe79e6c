#include <algorithm>

#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/inline/inline_consumer.hpp>

namespace gale::detail {

InlineConsumer::InlineConsumer(const Mesh& mesh, RelationSet relations, std::shared_ptr<ConsumerLog> log)
    : mesh_(mesh), relations_(relations), faces_(mesh, relations & face_relations), log_(std::move(log)) {
  for (const RelationSet kernel : kernels_for(relations - face_relations)) blocks_.emplace_back(mesh, kernel);
}

InlineConsumer::~InlineConsumer() { log_->add(statistics_); }

SegmentRows InlineConsumer::load(RelationSet one, Id simplex) {
  require_preconditioned(relations_, one);
  const int dimension = row_dimension(one);
  require_simplex(mesh_, dimension, simplex);
  if (face_relations.contains(one)) return faces_.row(members_of(one).front(), simplex);
  const auto has = [one](const RecentBlocks& blocks) { return blocks.relations().contains(one); };
  return std::find_if(blocks_.begin(), blocks_.end(), has)
      ->rows_of(one, mesh_.segment_of(dimension, simplex), statistics_);
}

}  // namespace gale::detail
