#pragma once

#include <vector>

#include <gale/runtime/inline/inline_structure.hpp>

namespace gale::detail {

/// What one kernel made last for a consumer, for some segments.
class RecentBlocks {
 public:
  /// `mesh` must outlive it.
  RecentBlocks(const Mesh& mesh, RelationSet relations) : mesh_(&mesh), relations_(relations) {}

  RelationSet relations() const { return relations_; }

  /// The rows of a segment. Those of `one`, a relation or the links, are valid until the next call for the same.
  const SegmentRows& rows_of(RelationSet one, Id segment, ConsumerStatistics& statistics) {
    for (Kept& kept : kept_) kept.readers = kept.readers - one;
    Kept& kept = find(segment);
    kept.readers = kept.readers | one;
    kept.last_use = ++now_;
    if (kept.rows.segment() == segment) {
      ++statistics.hits;
    } else {
      kept.rows = SegmentRows();
      kept.rows = compute_counted(kept.worker, segment, statistics);
    }
    return kept.rows;
  }

 private:
  /// More than relations that one kernel makes, of each of which the block read last stays.
  static constexpr std::size_t capacity = 32;

  struct Kept {
    HostWorker worker;
    SegmentRows rows;
    RelationSet readers;  ///< whose row was read here last
    std::int64_t last_use = 0;
  };

  /// Where the segment's blocks are kept, or where they may be.
  Kept& find(Id segment) {
    Kept* oldest = nullptr;
    for (Kept& kept : kept_) {
      if (kept.rows.segment() == segment) return kept;
      if (kept.readers.empty() && (oldest == nullptr || kept.last_use < oldest->last_use)) oldest = &kept;
    }
    if (kept_.size() == capacity) return *oldest;
    kept_.push_back({HostWorker(*mesh_, relations_), SegmentRows(), RelationSet(), 0});
    return kept_.back();
  }

  const Mesh* mesh_;
  RelationSet relations_;
  std::vector<Kept> kept_;
  std::int64_t now_ = 0;
};

}  // namespace gale::detail
