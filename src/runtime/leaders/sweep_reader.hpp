#pragma once

#include <gale/runtime/leaders/leader.hpp>

namespace gale::detail {

/// How one consumer of a sweep reads the blocks of one leader: an arena is pinned once for all of its segments that
/// come one after the other, since what many consumers touch for each segment, they wait for.
class SweepReader {
 public:
  /// `runs_ahead`: the leader runs ahead of this sweep, and wants to know what is read.
  SweepReader(Leader& leader, bool runs_ahead) : leader_(&leader), runs_ahead_(runs_ahead) {}
  ~SweepReader() { release(); }
  SweepReader(SweepReader&& other) noexcept
      : leader_(other.leader_),
        runs_ahead_(other.runs_ahead_),
        lease_(std::move(other.lease_)),
        read_(std::exchange(other.read_, 0)) {}

  /// The blocks of a segment, valid until the next call. Waits for them without holding others.
  const Lease& read(Id segment, ConsumerStatistics& statistics) {
    if (leader_->move(lease_, segment)) {
      ++statistics.hits;
    } else {
      release();
      lease_ = leader_->acquire(segment, runs_ahead_, statistics);
    }
    return lease_;
  }

  /// The segment that was read last won't be again.
  void done() { ++read_; }

  const Leader& leader() const { return *leader_; }

 private:
  void release() {
    if (!lease_) return;
    if (!runs_ahead_) {
      lease_.release();
    } else if (lease_.release_read(read_)) {
      leader_->tell_read();
    }
    read_ = 0;
  }

  Leader* leader_;
  bool runs_ahead_;
  Lease lease_;
  Id read_ = 0;  ///< segments of the lease's arena
};

}  // namespace gale::detail
