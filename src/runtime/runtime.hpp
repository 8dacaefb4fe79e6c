#pragma once

#include <memory>

#include <gale/runtime/options.hpp>
#include <gale/runtime/statistics.hpp>
#include <gale/runtime/structure.hpp>

namespace gale {

namespace detail {
class RuntimeImplementation;
}

/// The localized structure: relations are computed segment by segment when a consumer wants them or, on a device,
/// before it does, and forgotten again (the paper's §4).
///
/// With leaders, a consumer that finds no block pushes a request on the queue of its relation and waits. The queue's
/// leader takes all that wait, adds the segments that follow each, leaves out what is resident or under way, and
/// launches them as one batch; while that is copied to the host, the next computes. Blocks stay until the host budget
/// needs their place, the longest unread first. In a sweep the leaders run ahead of the consumers as far as the budget
/// goes.
///
/// Without a device, a consumer computes what it misses. In a sweep of fewer consumers than there are cores, helpers on
/// the others compute segments ahead of them (Way::helpers); a consumer takes what is ready, computes when nothing is,
/// and waits for nobody.
///
/// Rows of EF, ET, FT and TT are found among what begins with a vertex or its neighbours: their time grows with the
/// square of a vertex' degree, which a vertex in very many tetrahedra makes felt (20000 at one edge: some seconds). The
/// explicit structure's doesn't.
///
/// Any threads may be consumers, each through a `Consumer` of its own. An exception while a batch is computed reaches
/// each consumer that waits for one of its segments, as gale::Error.
class Runtime : public Structure {
 public:
  /// Preconditions `mesh` for the relations `wanted`: enumerates edges and triangles as far as these need them; and
  /// starts the leaders. Boundary relations have none: consumers look them up.
  Runtime(const Mesh& mesh, RelationSet wanted, const RuntimeOptions& options = {});

  /// Ends the leaders. A consumer that still waits gets a gale::Error.
  ~Runtime() override;

  const Mesh& mesh() const override;
  RelationSet relations() const override;
  void for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) override;
  std::unique_ptr<Consumer> consumer() override;

  /// Which way it is; never Way::automatic.
  Way way() const;

  RuntimeStatistics statistics() const;

 private:
  std::unique_ptr<detail::RuntimeImplementation> implementation_;
};

}  // namespace gale
