#pragma once

#include <cassert>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Segments by their place in a batch: those of an array, or consecutive ones. Owns nothing.
class SegmentList {
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

}  // namespace gale
