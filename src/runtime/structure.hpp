#pragma once

#include <memory>
#include <string>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/consumer.hpp>
#include <gale/runtime/statistics.hpp>
#include <gale/runtime/structure_options.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale {

/// Whatever answers which simplices touch which: segment by segment as they are wanted, or all rows at once. Each way
/// of computing (`Way`) is one; `make_structure` makes them. Algorithms are written against this and give the same
/// results on each.
///
/// Any threads may read, each through a `Consumer` of its own or in the body of a sweep. An exception while rows are
/// computed reaches each consumer that waits for them, as gale::Error.
class GALE_EXPORT Structure {
 public:
  virtual ~Structure();
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;

  /// The mesh whose relations it answers.
  const Mesh& mesh() const { return mesh_; }

  /// What it was preconditioned for.
  RelationSet relations() const { return relations_; }

  /// How it computes; never Way::gale.
  Way way() const { return way_; }

  /// What reports call it: the name of its way, or its own if it isn't one of make_structure's.
  virtual std::string name() const { return name_of(way_); }

  /// Has it every row at any time? Then a consumer reads each in a few ns. Else rows of face relations come from the
  /// mesh's tables, and `face_row` is the fast way to them.
  virtual bool keeps_all_rows() const { return false; }

  /// How many simplices of a dimension 0 to 3 there are; no_id for edges and triangles that nobody needed so far.
  virtual Id count(int dimension) const;

  /// A sweep: calls `body` once for every segment (of ghosts none), in no order to rely on, with the rows of the
  /// relations `wanted`, on `options.threads` consumer threads. If a body throws, no further segment is begun and the
  /// exception is thrown again here. Throws gale::Error if `wanted` has a relation that was not preconditioned.
  ///
  /// What a body may do: read the rows that it is given, and others through a consumer of its own. It may copy Views
  /// and take subviews: Kokkos counts no references on its thread meanwhile, since it doesn't count atomically where
  /// Serial is its only backend. So what a body copies must not outlive the View that it copied, and a View that it
  /// makes must not outlive the body. It must begin no parallel loop of Kokkos where Serial is the only backend. What
  /// bodies share they may change by gale::atomic_add and its like (base/atomic.hpp), not by Kokkos' atomics, which are
  /// none there.
  void for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body);

  /// Makes a consumer, for rows in any order. Any thread may make one, and any number of them.
  virtual std::unique_ptr<Consumer> consumer() = 0;

  /// What it did since it was made.
  StructureStatistics statistics() const;

  /// For whoever made it: says in statistics().notices what is different from what was asked for. Before it is used.
  void add_notice(const std::string& notice) { notices_.push_back(notice); }

 protected:
  /// For the ways of computing, which derive from this.
  Structure(const Mesh& mesh, RelationSet relations, Way way);

  /// One sweep over all segments: what `for_each_segment` runs. Made when the sweep begins, gone when it ends.
  class Sweep {
   public:
    /// `consumers`: how many.
    explicit Sweep(int consumers) : statistics(consumers) {}
    virtual ~Sweep() = default;

    /// Calls `body` with the rows of `segment`, or of another one that no call was made for: as often as there are
    /// segments. By a consumer's thread, each with a number of its own.
    virtual void visit(int consumer, Id segment, const SegmentBody& body) = 0;

    /// After all segments were visited, if none has failed.
    virtual void end() {}

    std::vector<ConsumerStatistics> statistics;  ///< by consumer
  };

  /// Begins a sweep of so many consumers, which will read the relations `wanted`.
  virtual std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) = 0;

  /// Adds what the consumers don't know.
  virtual void add_statistics(StructureStatistics&) const {}

  /// For consumers, which add what they did when they end.
  const std::shared_ptr<detail::ConsumerLog>& log() const { return log_; }

 private:
  const Mesh mesh_;
  const RelationSet relations_;
  const Way way_;
  const std::shared_ptr<detail::ConsumerLog> log_;
  std::vector<std::string> notices_;
};

}  // namespace gale
