#pragma once

#include <optional>

#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/mesh/exchange/home_table.hpp>

namespace gale::detail {

/// Where a vertex comes from, and where it goes to.
struct VertexEntry {
  int giver = -1;    ///< the lowest rank that hands it over; -1 if none does
  Id place = no_id;  ///< there, among the vertices that it hands over
  int owner = -1;    ///< the rank that owns it, as the giver says
};

/// The vertices that a rank owns.
struct OwnedVertices {
  OwnedIds ids;
  Array<VertexEntry, HostMemory>
      entries;  ///< theirs, by ascending id; none where intervals are given and `ids` are one
};

/// Who knows which vertex: spread over the ranks, or known to all. Made and asked by all ranks together.
class VertexDirectory {
 public:
  /// Takes the vertices that each rank hands over: their ids (a vertex may come from several ranks, and from one
  /// several times), and who is to own each, which it keeps and corrects where a lower rank says otherwise.
  VertexDirectory(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                  const Array<int, HostMemory>& owners);

  /// Where each rank hands over an interval, and each vertex belongs to the lowest rank that hands it over.
  VertexDirectory(const Communicator& ranks, const GivenIntervals& given);

  /// How many different vertices there are on all ranks.
  Offset vertices() const { return vertices_; }

  /// Says who owns the vertex that this rank hands over at a place.
  int owner_of_handed(Id place) const {
    return given_ ? given_->giver(given_->of(ranks_.rank()).begin + place) : owners_of_handed_(place);
  }

  /// The entries of any vertices. Collective.
  Array<VertexEntry, HostMemory> find(const Array<const GlobalId, HostMemory>& ids) const;

  /// The vertices that this rank owns. Collective.
  OwnedVertices owned() const;

  /// What the ranks hand over, where these are intervals: then each vertex comes from the rank that owns it.
  const std::optional<GivenIntervals>& given() const { return given_; }

 private:
  Communicator ranks_;
  std::optional<GivenIntervals> given_;

  // Empty where intervals are given.
  HomeTable<VertexEntry> table_;
  Array<int, HostMemory> owners_of_handed_;

  Offset vertices_;
};

/// For each point that this rank hands over, the rank that is to own it: the ranks share the space-filling curve
/// through all points, so that each owns about as many, which lie close to each other. By samples, the same ones in
/// each run; points at one place are told apart by their ids. Collective; throws gale::Error if a coordinate isn't
/// finite.
Array<int, HostMemory> curve_partition(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                       const HostPoints& points);

}  // namespace gale::detail
