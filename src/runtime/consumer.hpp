#pragma once

#include <array>

#include <gale/export.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// How one thread reads rows in any order. Made by a `Structure`, which must outlive it; used by one thread at a time.
///
/// A row stays valid until this consumer asks for its next row of the same relation.
class GALE_EXPORT Consumer {
 public:
  virtual ~Consumer() = default;

  /// The row of a simplex (GALE's id). A few ns inside the segment that was asked for last; else what it takes to have
  /// the block computed, or, in a face relation, to look it up (`face_row` does that without a call). Throws
  /// gale::Error if the relation was not preconditioned, if there is no such simplex, or if it can't be computed.
  Row row(Relation relation, Id simplex) {
    SegmentRows& rows = current_[static_cast<int>(relation)];
    if (!rows.has(row_dimension(relation), simplex)) reload(rows, relation, simplex);
    return rows[relation][simplex];
  }

  /// The link of a vertex (GALE's id), as `row` has rows: the same cost, errors, and validity.
  LinkRow link(Id vertex) {
    SegmentRows& rows = current_[relation_count];
    if (!rows.has(0, vertex)) reload(rows, link_form, vertex);
    return rows.links()[vertex];
  }

 protected:
  /// Rows of one relation, or the links: `one` has that alone. The row of `simplex` is among them. Valid until the next
  /// call for the same.
  virtual SegmentRows load(RelationSet one, Id simplex) = 0;

 private:
  /// Forgets the old rows first: loading ends their validity, also if it throws.
  void reload(SegmentRows& rows, RelationSet one, Id simplex) {
    rows = SegmentRows();
    rows = load(one, simplex);
  }

  std::array<SegmentRows, relation_count + 1> current_;  ///< by relation; the last has links
};

}  // namespace gale
