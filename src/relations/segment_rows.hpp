#pragma once

#include <array>

#include <gale/base/types.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// The blocks of one segment, one for each relation that was asked for. Owns nothing: whoever hands it out says how long it is valid.
class SegmentRows {
 public:
  SegmentRows() = default;
  SegmentRows(Id segment, Id first, Id last) : segment_(segment), first_(first), last_(last) {}

  void set(Relation relation, const Id* block) { blocks_[static_cast<int>(relation)] = block; }
  const Id* block(Relation relation) const { return blocks_[static_cast<int>(relation)]; }

  Id segment() const { return segment_; }

  /// Its vertices are first() to last() - 1 (GALE's ids).
  Id first() const { return first_; }
  Id last() const { return last_; }
  bool has(Id vertex) const { return vertex >= first_ && vertex < last_; }

  /// Rows of a relation that was asked for: of the segment's vertices.
  Rows operator[](Relation relation) const { return layout().rows_in(block(relation)); }
  LinkRows links() const { return layout().links_in(block(Relation::link)); }

 private:
  BlockLayout layout() const { return {first_, last_ - first_}; }

  Id segment_ = no_id;
  Id first_ = 0;
  Id last_ = 0;
  std::array<const Id*, relation_count> blocks_{};
};

}  // namespace gale
