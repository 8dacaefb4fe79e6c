#pragma once

#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/distributed/dealt.hpp>
#include <gale/distributed/global_index.hpp>

namespace gale::detail {

/// Where a vertex comes from, and where it goes to.
struct VertexEntry {
  int giver = -1;    ///< the lowest rank that hands it over; -1 if none does
  Id place = no_id;  ///< there, among the vertices that it hands over
  int owner = -1;    ///< the rank that owns it, as the giver says
};

/// Who knows which vertex, spread over the ranks: each keeps the entries of an interval of global ids. Made and asked
/// by all ranks together.
class VertexDirectory {
 public:
  /// Of the vertices that each rank hands over: their ids (a vertex may come from several ranks, and from one several
  /// times), and who is to own each.
  VertexDirectory(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                  const Array<const int, HostMemory>& owners);

  /// How many different vertices there are on all ranks.
  Offset vertices() const { return vertices_; }

  /// The entries of any vertices.
  Array<VertexEntry, HostMemory> find(const Array<const GlobalId, HostMemory>& ids) const;

  /// The vertices that this rank owns, ascending.
  GlobalIds owned() const;

 private:
  int home_of(GlobalId id) const { return static_cast<int>(id / ids_a_home_); }

  Communicator ranks_;
  GlobalId ids_a_home_;
  Offset vertices_;
  GlobalIndex index_;                       ///< of the ids that this rank keeps
  Array<VertexEntry, HostMemory> entries_;  ///< theirs
};

}  // namespace gale::detail
