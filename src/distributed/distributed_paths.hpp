#pragma once

#include <functional>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale::detail {

/// The simplices of one kind that paths lead through, vertices or tetrahedra, as one rank has them.
struct PathSimplices {
  const Mirrored<Id>* successors;      ///< by GALE's id; those that another rank knows are elsewhere
  const std::vector<Id>* critical;     ///< GALE's ids
  std::function<GlobalId(Id)> global;  ///< GALE's id -> global id
  std::function<Id(GlobalId)> local;   ///< and back, of those that this rank holds
  std::function<int(Id)> owner;        ///< the rank that knows the successor
};

/// Where a path goes on or ends.
struct Stop {
  static constexpr int critical = -1, outside = -2;

  int rank = outside;  ///< that has to follow the path on; or how it ends
  GlobalId id = -1;    ///< of the simplex where it goes on, or of the critical one where it ends

  bool is_end() const { return rank < 0; }
};

/// The ends of all paths along the successors of a mesh on several ranks, by pointer jumping: first on each rank, then
/// from rank to rank, in a number of rounds that grows with the logarithm of how often a path changes ranks.
class DistributedPaths {
 public:
  /// Collective; throws gale::Error on all ranks.
  DistributedPaths(const Communicator& ranks, const PathSimplices& simplices);

  /// How the path from each local simplex (GALE's id) ends on this rank: at places()-th of the critical ones, or of the
  /// exits after them; no_id if it leaves through the surface.
  Id end(Id simplex) const;

  /// Exits: simplices of this rank that another one follows the paths of. Ends are numbered: first the critical ones,
  /// then the exits.
  Id ends() const { return criticals_ + static_cast<Id>(exits_.size()); }
  bool is_exit(Id end) const { return end >= criticals_; }

  /// Where the paths that end here so end finally.
  Stop final_stop(Id end) const;

  /// How many rounds of messages it took.
  int rounds() const { return static_cast<int>(stops_.size()) - 1; }

  /// stops(round)[i]: where the path from the i-th exit is after 2^round changes of ranks, or ends before.
  const std::vector<Stop>& stops(int round) const { return stops_[round]; }
  Id exit_of(Id end) const { return end - criticals_; }

  const PathSimplices& simplices() const { return simplices_; }

 private:
  void find_exits();
  bool jump(const Communicator& ranks);

  PathSimplices simplices_;
  Id criticals_;
  std::vector<Id> exits_;
  Array<const Id, HostMemory> ends_;  ///< by simplex: end_at(number), or path_outside
  std::vector<std::vector<Stop>> stops_;
};

}  // namespace gale::detail
