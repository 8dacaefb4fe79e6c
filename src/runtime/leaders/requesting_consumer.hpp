#pragma once

#include <gale/relations/face_reader.hpp>
#include <gale/runtime/leaders/leaders.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// A consumer that asks leaders for what it misses, and waits.
class RequestingConsumer : public Consumer {
 public:
  RequestingConsumer(std::shared_ptr<Leaders> leaders, std::shared_ptr<ConsumerLog> log)
      : leaders_(std::move(leaders)),
        log_(std::move(log)),
        faces_(leaders_->mesh(), leaders_->relations() & face_relations) {}
  ~RequestingConsumer() override { log_->add(statistics_); }

 protected:
  SegmentRows load(RelationSet one, Id simplex) override {
    const Mesh& mesh = leaders_->mesh();
    const int dimension = row_dimension(one);
    require_preconditioned(leaders_->relations(), one);
    require_simplex(mesh, dimension, simplex);
    if (face_relations.contains(one)) return faces_.row(members_of(one).front(), simplex);
    Leader& leader = leaders_->of(one);
    const Id segment = mesh.segment_of(dimension, simplex);
    Lease& lease = leases_[all_relations.contains(one) ? static_cast<int>(members_of(one).front()) : relation_count];
    lease.release();
    lease = leader.acquire(segment, false, statistics_);
    SegmentRows rows(segment, mesh.intervals_of(segment));
    leader.add_rows(lease, rows);
    return rows;
  }

 private:
  const std::shared_ptr<Leaders> leaders_;
  const std::shared_ptr<ConsumerLog> log_;
  FaceReader faces_;
  ConsumerStatistics statistics_;
  Lease leases_[relation_count + 1];  ///< of the block read last in each relation; the last is that of links
};

}  // namespace gale::detail
