#pragma once

#include <array>

#include <gale/base/types.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// The rows of one segment, of each relation that was asked for. Owns nothing: whoever hands it out says how long it is
/// valid.
class SegmentRows {
 public:
  SegmentRows() = default;
  SegmentRows(Id segment, Id first, Id last) : segment_(segment), first_(first), last_(last) {}

  /// A relation's rows as they lie in a block of the segment's vertices.
  void set(Relation relation, const Id* block) {
    const BlockLayout layout{first_, last_ - first_};
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

  /// Its vertices are first() to last() - 1 (GALE's ids).
  Id first() const { return first_; }
  Id last() const { return last_; }
  bool has(Id vertex) const { return vertex >= first_ && vertex < last_; }

  /// Rows of a relation that was asked for: of the segment's vertices.
  const Rows& operator[](Relation relation) const { return rows_[static_cast<int>(relation)]; }
  const LinkRows& links() const { return links_; }

 private:
  Id segment_ = no_id;
  Id first_ = 0;
  Id last_ = 0;
  LinkRows links_;
  std::array<Rows, relation_count - 1> rows_{};  // all but link, which is the last
};

}  // namespace gale
