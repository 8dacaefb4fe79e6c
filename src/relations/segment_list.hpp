#pragma once

#include <cassert>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Segments by their place in a batch: those of an array, or consecutive ones. Owns nothing.
class SegmentList {
 public:
  KOKKOS_DEFAULTED_FUNCTION SegmentList() = default;
  KOKKOS_FUNCTION SegmentList(const Id* segments) : segments_(segments) {}

  /// `first`, first + 1, ...
  KOKKOS_FUNCTION static SegmentList from(Id first) {
    SegmentList list;
    list.first_ = first;
    return list;
  }

  /// The segments from a place on.
  KOKKOS_FUNCTION SegmentList from_place(Id place) const {
    return segments_ == nullptr ? from(first_ + place) : SegmentList(segments_ + place);
  }

  KOKKOS_FUNCTION Id operator[](Id place) const {
    assert((segments_ != nullptr || first_ >= 0) && "there are no segments");
    return segments_ == nullptr ? first_ + place : segments_[place];
  }

 private:
  const Id* segments_ = nullptr;
  Id first_ = no_id;
};

}  // namespace gale
