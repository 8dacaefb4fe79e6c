#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/consumer.hpp>
#include <gale/runtime/statistics.hpp>

namespace gale::detail {

/// A consumer that looks up rows of face relations in the mesh's tables, and has those of others by segments.
class SegmentConsumer : public Consumer {
 public:
  /// Enumerates what face relations need, if it isn't there.
  SegmentConsumer(const Mesh& mesh, RelationSet relations, std::shared_ptr<ConsumerLog> log)
      : mesh_(mesh),
        relations_(relations),
        simplices_(mesh.simplices(needs_of(relations & face_relations, mesh.dimension()))),
        log_(std::move(log)) {}
  ~SegmentConsumer() override { log_->add(statistics_); }

 protected:
  /// The rows of a segment in one relation that is none to faces, or the links. Valid until the next call for the same.
  virtual SegmentRows rows_of(RelationSet one, Id segment) = 0;

  const Mesh mesh_;
  ConsumerStatistics statistics_;

 private:
  SegmentRows load(RelationSet one, Id simplex) final {
    require_preconditioned(relations_, one);
    const int dimension = row_dimension(one);
    require_simplex(mesh_, dimension, simplex);
    if (face_relations.contains(one)) return faces_of(members_of(one).front(), simplex);
    return rows_of(one, mesh_.segment_of(dimension, simplex));
  }

  SegmentRows faces_of(Relation relation, Id simplex) {
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

  struct Found {
    Id offsets[2] = {0, 0};
    std::array<Id, 6> ids{};
  };

  const RelationSet relations_;
  const Simplices<HostMemory> simplices_;
  std::array<Found, 6> found_;  ///< by face relation, which are the first
  const std::shared_ptr<ConsumerLog> log_;
};

}  // namespace gale::detail
