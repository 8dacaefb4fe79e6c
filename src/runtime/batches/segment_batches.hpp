#pragma once

#include <cassert>

#include <gale/relations/batch.hpp>

namespace gale {

namespace detail {

/// The blocks of some segments, of all relations that a sweep was asked for: a Batch for each kernel, in the same
/// slots. A value that owns nothing, readable wherever `Memory` is.
template <class Memory>
struct SegmentBatches {
  static constexpr int most_kernels = relation_count + 1 - 2;  ///< one makes VV, VT and links

  Batch<Memory> of[most_kernels];
  int kernels = 0;

  /// Segments, some of which may be missing.
  KOKKOS_FUNCTION Id count() const { return of[0].count; }

  /// Has a slot all its blocks?
  KOKKOS_FUNCTION bool has(Id slot) const {
    bool all = true;
    for (int k = 0; k < kernels; ++k) all &= of[k].has(slot);
    return all;
  }

  /// The batch that has a relation, or the links.
  KOKKOS_FUNCTION const Batch<Memory>& with(RelationSet one) const {
    int k = 0;
    while (k + 1 < kernels && !of[k].relations.contains(one)) ++k;
    assert(of[k].relations.contains(one) && "the sweep was not asked for this relation");
    return of[k];
  }
};

}  // namespace detail

/// The rows of one segment where a kernel can read them, of each relation that the sweep was asked for: what
/// SegmentRows is to consumers on the host. Owns nothing; valid during the call that it is handed to.
///
/// To read rows of a relation that was not asked for, or of a simplex that another segment has, is an error of the
/// caller: an assertion where NDEBUG is not defined, undefined otherwise.
template <class Memory>
class SegmentRowsIn {
 public:
  /// Made by sweeps, which hand it to their functors.
  KOKKOS_FUNCTION SegmentRowsIn(const detail::SegmentBatches<Memory>& batches, Id slot)
      : batches_(batches), slot_(slot) {}

  /// The segment that the rows are those of.
  KOKKOS_FUNCTION Id segment() const { return batches_.of[0].segments[slot_]; }

  /// The segment's simplices that a relation has rows for (GALE's ids): `for (Id edge : rows.interval(Relation::EF))`.
  KOKKOS_FUNCTION Interval interval(Relation relation) const { return interval(row_dimension(relation)); }

  /// The segment's simplices of a dimension 0 to 3; empty where they were not enumerated.
  KOKKOS_FUNCTION Interval interval(int dimension) const { return batches_.of[0].intervals(dimension, segment()); }

  /// The rows of a relation, one for each simplex of interval(relation).
  KOKKOS_FUNCTION Rows operator[](Relation relation) const { return batches_.with(relation).rows(slot_, relation); }

  /// The links, one for each vertex.
  KOKKOS_FUNCTION LinkRows links() const { return batches_.with(link_form).links(slot_); }

 private:
  const detail::SegmentBatches<Memory>& batches_;
  Id slot_;
};

}  // namespace gale
