#pragma once

#include <cassert>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale {

/// Segments by their place in a batch: those of an array, or consecutive ones. Owns nothing.
class GALE_EXPORT SegmentList {
 public:
  /// A list of no segments.
  KOKKOS_DEFAULTED_FUNCTION SegmentList() = default;

  /// The segments of an array, which must outlive it.
  KOKKOS_FUNCTION SegmentList(const Id* segments) : segments_(segments) {}

  /// The segments `first`, first + 1, ...
  KOKKOS_FUNCTION static SegmentList from(Id first) {
    SegmentList list;
    list.first_ = first;
    return list;
  }

  /// The list without the segments before a place.
  KOKKOS_FUNCTION SegmentList from_place(Id place) const {
    return segments_ == nullptr ? from(first_ + place) : SegmentList(segments_ + place);
  }

  /// The segment at a place, counted from 0.
  KOKKOS_FUNCTION Id operator[](Id place) const {
    assert((segments_ != nullptr || first_ >= 0) && "there are no segments");
    return segments_ == nullptr ? first_ + place : segments_[place];
  }

 private:
  const Id* segments_ = nullptr;
  Id first_ = no_id;
};

/// Where the simplices of each dimension that are internal to a segment begin, by segment (I_V, I_E, I_F and I_T), for
/// code that can read `Memory`. Null for what is not enumerated. Owns nothing.
template <class Memory>
struct IntervalTables {
  const Id* begin[4] = {};  ///< by dimension: segment -> its first simplex, and one past the last

  /// The simplices of a dimension that are internal to a segment; none where they aren't enumerated.
  KOKKOS_FUNCTION Interval operator()(int dimension, Id segment) const {
    return begin[dimension] == nullptr ? Interval()
                                       : Interval{begin[dimension][segment], begin[dimension][segment + 1]};
  }
};

/// Takes the tables of a mesh. To be called on the host.
template <class Memory = HostMemory>
IntervalTables<Memory> interval_tables(const Mesh& mesh) {
  IntervalTables<Memory> tables;
  for (int dimension = 0; dimension <= mesh.dimension(); ++dimension) {
    const bool enumerated =
        (dimension != 1 || mesh.known_edges() != no_id) && (dimension != 2 || mesh.known_triangles() != no_id);
    if (enumerated) tables.begin[dimension] = mesh.interval_begin<Memory>(dimension).data();
  }
  return tables;
}

/// The blocks of some segments: what one run of a kernel leaves in `Memory`. A value that owns nothing; its rows are
/// readable wherever `Memory` is, in kernels and on the host, as long as whoever made it keeps the arrays.
///
/// A segment of the batch is named by its slot, 0 to count - 1. It has all its blocks or, where the kernel lacked room,
/// none.
template <class Memory>
struct Batch {
  RelationSet relations;              ///< what each segment has a block of
  Id count = 0;                       ///< how many segments there are
  SegmentList segments;               ///< slot -> segment
  const Offset* directory = nullptr;  ///< slot and relation -> where the block begins in `words`; below 0 if missing
  const Id* words = nullptr;          ///< the blocks, see BlockLayout
  IntervalTables<Memory> intervals;   ///< the mesh's

  /// Are the blocks of a slot there?
  KOKKOS_FUNCTION bool has(Id slot) const { return directory[Offset(slot) * relations.count()] >= 0; }

  /// The rows of a relation of the segment in a slot, whose blocks must be there.
  KOKKOS_FUNCTION Rows rows(Id slot, Relation relation) const {
    return layout(slot, row_dimension(relation)).rows_in(block(slot, relations.index_of(relation)));
  }

  /// The links of the segment in a slot, whose blocks must be there.
  KOKKOS_FUNCTION LinkRows links(Id slot) const {
    return layout(slot, 0).links_in(block(slot, relations.index_of_links()));
  }

 private:
  KOKKOS_FUNCTION BlockLayout layout(Id slot, int dimension) const {
    const Interval simplices = intervals(dimension, segments[slot]);
    return {simplices.first, simplices.size()};
  }
  KOKKOS_FUNCTION const Id* block(Id slot, int index) const {
    return words + directory[Offset(slot) * relations.count() + index];
  }
};

/// Adds all rows that a batch has of a slot to those of its segment.
inline void add_rows(const Batch<HostMemory>& batch, Id slot, SegmentRows& rows) {
  for (const Relation relation : members_of(batch.relations)) rows.set(relation, batch.rows(slot, relation));
  if (batch.relations.has_links()) rows.set(batch.links(slot));
}

}  // namespace gale
