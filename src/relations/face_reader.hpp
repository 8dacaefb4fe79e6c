#pragma once

#include <array>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::detail {

/// How a consumer looks up rows of face relations. Used by one thread at a time.
class FaceReader {
 public:
  /// `relations`: some of face_relations, or none. Enumerates what they need, if it isn't there.
  FaceReader(const Mesh& mesh, RelationSet relations);

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

}  // namespace gale::detail
