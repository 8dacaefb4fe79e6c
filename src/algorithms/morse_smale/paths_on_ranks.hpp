#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/paths_here.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/mirrored.hpp>

namespace gale::detail {

/// The simplices of one kind that paths along a gradient, or another field, lead through, as one rank has them. Refers
/// to what it is made from.
class PathSimplices {
 public:
  enum class Kind { falling_vertices, rising_cells };

  PathSimplices(const DiscreteGradient& gradient, Kind kind);

  /// Vertices alone: `successors` are elsewhere at ghosts, and `ends` are those that have none.
  PathSimplices(const VertexOrder& order, const Mirrored<Id>& successors, const std::vector<Id>& ends);

  /// Makes them on all ranks. Collective; throws gale::Error on all.
  static std::unique_ptr<const PathSimplices> make(const DiscreteGradient& gradient, Kind kind);

  const Mesh& mesh() const { return mesh_; }
  bool are_vertices() const { return are_vertices_; }

  /// The next simplex on the path from each, by GALE's id; those that another rank knows are elsewhere.
  const Mirrored<Id>& successors() const { return successors_; }

  /// Where paths end: GALE's ids.
  const std::vector<Id>& critical() const { return critical_; }

  /// GALE's id -> global id, and back for those that this rank shares with others.
  GlobalId global(Id simplex) const;
  Id local(GlobalId id) const;

  /// An interval of simplices (GALE's ids) all of whose successors this rank knows; empty for cells that aren't a
  /// grid's.
  Interval inner() const;

  /// Cells that aren't a grid's and have a ghost: those that other ranks hold, too.
  const Array<const Id, HostMemory>& shared() const { return shared_; }

  /// The ranks that know the successors of some simplices. Finds them where successors are.
  std::vector<int> owners(const std::vector<Id>& simplices) const;

 private:
  std::vector<Id> highest_corners(const std::vector<Id>& cells) const;

  const VertexOrder& order_;
  const Mesh mesh_;
  const bool are_vertices_;
  const Mirrored<Id>& successors_;
  const std::vector<Id>& critical_;
  const OtherIds input_, vertex_input_;
  Array<const Id, HostMemory> shared_;
  HashTable<Id> shared_cells_;  ///< input cell -> GALE's, of shared()
};

/// Where a path goes on or ends.
struct PathStop {
  static constexpr int critical = -1, outside = -2;

  std::int64_t rank = outside;  ///< that the path has come to, or how it ends; in 64 bits to be packed without gaps
  std::int64_t at = -1;         ///< which of that rank's exits it has come to, or the name of the critical simplex

  bool is_end() const { return rank < 0; }
};

/// How the path from an exit goes on.
struct ExitLink {
  std::int32_t owner = -1;  ///< the rank that follows it
  Id exit = no_id;          ///< which of that rank's exits it comes to; no_id: it ends there
};

/// The exits of one rank: simplices that others follow the paths of.
struct ExitLinks {
  Array<const Id, HostMemory> exits;        ///< GALE's ids, ascending
  Array<const ExitLink, HostMemory> links;  ///< of those that some path comes to; the others' are unwritten
  std::vector<Id> wanted;                   ///< the places of those that paths were asked for, once each
};

/// The ends of paths along the successors of a mesh on several ranks: first on each rank, then by pointer jumping from
/// rank to rank, in a number of rounds that grows with the logarithm of how often a path changes ranks. Where few do so
/// more than once, all ranks are told where these come to, instead of most rounds.
class PathsOnRanks {
 public:
  /// Finds those of paths of vertices, upwards from their first_cells(), of simplices that others share, and from
  /// `others` (GALE's ids), whose successors may be elsewhere. `names`, 0 or more, are those of the rank's critical
  /// simplices, by which all ranks are to know them. Paths are few if all ranks together are told of `most_told` at
  /// most, each as often as there are ranks: 16 bytes. Collective; throws gale::Error on all ranks. Refers to
  /// `simplices`.
  PathsOnRanks(const PathSimplices& simplices, const Array<const std::int64_t, HostMemory>& names,
               const std::vector<Id>& others = {}, Offset most_told = Offset(1) << 20);

  /// Finds the exits of these paths alone, and where each goes on: no names of ends. Likewise.
  PathsOnRanks(const PathSimplices& simplices, const std::vector<Id>& others);

  /// How the paths of vertices end on this rank, from starts()[vertex], or of each vertex, where there are no starts:
  /// `end_at` (jump.hpp) the number of that end, below. Where the successors are, if there was room.
  const Mirrored<Id>& ends_here() const { return ends_.of_entries; }
  const Mirrored<Id>& starts() const { return starts_; }

  /// The numbers of the ends of some simplices' paths here; no_id for one that leaves through the surface. Not
  /// collective.
  std::vector<Id> ends_of(const std::vector<Id>& simplices) const;

  /// All exits, of which those are wanted that paths from some simplices (GALE's ids) come to: where successors are
  /// elsewhere, some of the `others`. Not collective.
  ExitLinks exits_from(const std::vector<Id>& simplices) const;

  /// Exits: simplices of this rank that another one follows the paths of. Ends are numbered: first the critical ones,
  /// then the exits.
  Id ends() const { return criticals_ + static_cast<Id>(exits_.extent(0)); }

  /// The name of the critical simplex at which the paths that end here so end finally; -1 if that is outside, or an
  /// exit that no path comes to that was asked for.
  std::int64_t final_name(Id end) const {
    const PathStop stop = end < criticals_ ? stop_here(end) : stops_(end - criticals_);
    return stop.rank == PathStop::critical ? stop.at : -1;
  }

  /// How many rounds of messages it took.
  int rounds() const { return rounds_; }

  const PathSimplices& simplices() const { return simplices_; }
  const Ranks& ranks() const { return simplices_.mesh().exchange().ranks(); }

 private:
  void begin(const std::vector<Id>& others);
  void ask_owners(const Array<Id, HostMemory>& reached);
  bool follow_told(Offset most_told);
  bool jump();
  PathStop stop_here(Id end) const;

  const PathSimplices& simplices_;
  const Id criticals_;
  Array<const std::int64_t, HostMemory> names_;  ///< of the critical simplices
  Array<Id, HostMemory> exits_;                  ///< ascending
  EndsHere ends_;
  Mirrored<Id> starts_;
  Array<PathStop, HostMemory> stops_;  ///< of each exit: where paths from there have come to so far
  Array<ExitLink, HostMemory> links_;  ///< of each exit
  std::vector<Id> open_;               ///< the places of those whose paths haven't ended yet
  int rounds_ = 0;
};

/// For each vertex that this rank holds, its ghosts, too, by input id, names[end] of the end of its path here; no_id
/// where that is, where no path starts, or it leaves through the surface. Collective.
Mirrored<Id> ends_of_vertices(const PathsOnRanks& paths, const Array<const Id, HostMemory>& names);

}  // namespace gale::detail
