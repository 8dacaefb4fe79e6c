#pragma once

#include <array>

#include <gale/mesh/intervals.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// The rows of one segment, of each relation that was asked for. Owns nothing: whoever hands it out says how long it is
/// valid.
class SegmentRows {
 public:
  SegmentRows() = default;

  /// Of a segment, or of any simplices; no rows yet.
  SegmentRows(Id segment, const Intervals& simplices) : segment_(segment), simplices_(simplices) {}

  /// A relation's rows as they lie in a block.
  void set(Relation relation, const Id* block) {
    const Interval& rows = simplices_[row_dimension(relation)];
    const BlockLayout layout{rows.first, rows.size()};
    if (relation == Relation::link) {
      links_ = layout.links_in(block);
    } else {
      rows_[static_cast<int>(relation)] = layout.rows_in(block);
    }
  }

  /// Rows that lie elsewhere, e.g. among those of all segments. For each relation but `link`; and for that.
  void set(Relation relation, const Rows& rows) { rows_[static_cast<int>(relation)] = rows; }
  void set(const LinkRows& links) { links_ = links; }

  Id segment() const { return segment_; }

  /// Its simplices of a dimension are first(dimension) to last(dimension) - 1 (GALE's ids): those whose lowest vertex
  /// it holds.
  Id first(int dimension = 0) const { return simplices_[dimension].first; }
  Id last(int dimension = 0) const { return simplices_[dimension].last; }
  bool has(int dimension, Id simplex) const { return simplices_[dimension].has(simplex); }

  /// Rows of a relation that was asked for: of the segment's simplices of row_dimension(relation).
  const Rows& operator[](Relation relation) const { return rows_[static_cast<int>(relation)]; }
  const LinkRows& links() const { return links_; }

 private:
  Id segment_ = no_id;
  Intervals simplices_;
  LinkRows links_;
  std::array<Rows, relation_count - 1> rows_{};  // all but link, which is the last
};

}  // namespace gale
