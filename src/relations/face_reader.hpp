#pragma once

#include <algorithm>
#include <array>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::detail {

/// How a consumer looks up rows of face relations. Used by one thread at a time.
class FaceReader {
 public:
  /// `relations`: some of face_relations, or none. Enumerates what they need, if it isn't there.
  FaceReader(const Mesh& mesh, RelationSet relations)
      : simplices_(mesh.simplices(needs_of(relations, mesh.dimension()))) {}

  /// The row of a simplex, which must be one; valid until the next call for the same relation.
  SegmentRows row(Relation relation, Id simplex);

 private:
  struct Found {
    Id offsets[2] = {0, 0};
    std::array<Id, 6> ids{};
  };

  Simplices<HostMemory> simplices_;
  std::array<Found, 6> found_;  ///< by face relation, which are the first
};

inline SegmentRows FaceReader::row(Relation relation, Id simplex) {
  Found& found = found_[static_cast<int>(relation)];
  Id* const ids = found.ids.data();
  found.offsets[1] = with_faces_of(relation, [&](auto known) {
    const auto row = face_row<decltype(known)::value>(simplices_, simplex);
    return static_cast<Id>(std::copy(row.begin(), row.end(), ids) - ids);
  });
  Intervals one;
  one[row_dimension(relation)] = {simplex, simplex + 1};
  SegmentRows rows(no_id, one);
  rows.set(relation, Rows{simplex, 1, found.offsets, ids});
  return rows;
}

}  // namespace gale::detail
