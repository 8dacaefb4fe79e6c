#include <algorithm>

#include <gale/relations/face_reader.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

namespace gale::detail {

namespace {

/// Writes the row to `ids` if `relation` is the one wanted; its size then, else 0.
template <Relation relation>
Id write_if(Relation wanted, const Simplices<HostMemory>& simplices, Id simplex, Id* ids) {
  if (wanted != relation) return 0;
  const auto row = face_row<relation>(simplices, simplex);
  std::copy(row.begin(), row.end(), ids);
  return face_count(relation);
}

}  // namespace

FaceReader::FaceReader(const Mesh& mesh, RelationSet relations) : simplices_(mesh.simplices(needs_of(relations))) {}

SegmentRows FaceReader::row(Relation relation, Id simplex) {
  Found& found = found_[static_cast<int>(relation)];
  Id* const ids = found.ids.data();
  found.offsets[1] = write_if<Relation::EV>(relation, simplices_, simplex, ids) +
                     write_if<Relation::FV>(relation, simplices_, simplex, ids) +
                     write_if<Relation::FE>(relation, simplices_, simplex, ids) +
                     write_if<Relation::TV>(relation, simplices_, simplex, ids) +
                     write_if<Relation::TE>(relation, simplices_, simplex, ids) +
                     write_if<Relation::TF>(relation, simplices_, simplex, ids);
  Intervals one;
  one[row_dimension(relation)] = {simplex, simplex + 1};
  SegmentRows rows(no_id, one);
  rows.set(relation, Rows{simplex, 1, found.offsets, ids});
  return rows;
}

}  // namespace gale::detail
