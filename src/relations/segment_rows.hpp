#pragma once

#include <cassert>

#include <gale/mesh/intervals.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale {

/// The rows of one segment, of each relation that was asked for. Owns nothing: whoever hands it out says how long it is
/// valid.
///
/// To read rows of a relation that was not asked for, or of a simplex that another segment has, is an error of the
/// caller: an assertion where NDEBUG is not defined, undefined otherwise.
class SegmentRows {
 public:
  /// No segment, and no rows.
  SegmentRows() = default;

  /// A segment, or any simplices, without rows so far.
  SegmentRows(Id segment, const Intervals& simplices)
      : segment_(segment), simplices_{simplices[0], simplices[1], simplices[2], simplices[3]} {}

  /// Adds a relation's rows.
  void set(Relation relation, const Rows& rows) { rows_[static_cast<int>(relation)] = rows; }

  /// Adds the links.
  void set(const LinkRows& links) { links_ = links; }

  /// The segment that the rows are those of.
  KOKKOS_FUNCTION Id segment() const { return segment_; }

  /// The segment's simplices that a relation has rows for: those of the rows' dimension whose lowest vertex it holds
  /// (GALE's ids). `for (const Id edge : rows.interval(Relation::EF)) use(rows[Relation::EF][edge]);`
  KOKKOS_FUNCTION const Interval& interval(Relation relation) const { return interval(row_dimension(relation)); }

  /// The segment's simplices of a dimension 0 to 3; empty where they were not enumerated.
  KOKKOS_FUNCTION const Interval& interval(int dimension) const { return simplices_[dimension]; }

  /// Is a simplex of that dimension one of the segment's?
  KOKKOS_FUNCTION bool has(int dimension, Id simplex) const { return simplices_[dimension].has(simplex); }

  /// The rows of a relation, one for each simplex of interval(relation).
  KOKKOS_FUNCTION const Rows& operator[](Relation relation) const {
    assert(rows_[static_cast<int>(relation)].offsets != nullptr && "the sweep was not asked for this relation");
    return rows_[static_cast<int>(relation)];
  }

  /// The links, one for each vertex.
  KOKKOS_FUNCTION const LinkRows& links() const {
    assert(links_.offsets != nullptr && "the sweep was not asked for links");
    return links_;
  }

 private:
  Id segment_ = no_id;
  Interval simplices_[4];  // which kernels read: std::array's functions are the host's
  LinkRows links_;
  Rows rows_[relation_count];
};

}  // namespace gale
