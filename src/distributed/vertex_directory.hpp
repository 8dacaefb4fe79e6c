#pragma once

#include <gale/distributed/home_table.hpp>

namespace gale::detail {

/// Where a vertex comes from, and where it goes to.
struct VertexEntry {
  int giver = -1;    ///< the lowest rank that hands it over; -1 if none does
  Id place = no_id;  ///< there, among the vertices that it hands over
  int owner = -1;    ///< the rank that owns it, as the giver says
};

/// Who knows which vertex. Made and asked by all ranks together.
class VertexDirectory {
 public:
  /// Of the vertices that each rank hands over: their ids (a vertex may come from several ranks, and from one several
  /// times), and who is to own each.
  VertexDirectory(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                  const Array<const int, HostMemory>& owners);

  /// How many different vertices there are on all ranks.
  Offset vertices() const { return vertices_; }

  /// The entries of any vertices.
  Array<VertexEntry, HostMemory> find(const Array<const GlobalId, HostMemory>& ids) const {
    return table_.find(ranks_, ids);
  }

  /// The vertices that this rank owns, ascending.
  GlobalIds owned() const;

 private:
  Communicator ranks_;
  HomeTable<VertexEntry> table_;
  Offset vertices_;
};

}  // namespace gale::detail
