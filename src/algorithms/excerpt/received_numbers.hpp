#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange/global_index.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// A vertex that a rank has sent: its global id, and a number that compares on all ranks as the field's value does.
struct ReceivedVertex {
  GlobalId id;
  std::uint64_t value;
};

/// A cell that a rank has sent: its global id and its corners, places among the vertices that this rank has sent; of a
/// triangle the last one twice.
struct ReceivedCell {
  GlobalId id;
  std::array<Id, 4> corners;
};

/// What ranks have sent has a number each by its global id, which may have come from several.
template <class T>
class ReceivedNumbers {
 public:
  explicit ReceivedNumbers(const EntriesByRank<T>& received) : begin_(received.begin), number_(received.count()) {
    const auto all = allocate<GlobalIds>("GALE::received_ids", received.count());
    parallel_for("GALE::received_ids", HostExecutionSpace(), received.count(),
                 [&](Offset i) { all(i) = received.entries(i).id; });
    const DistinctIds distinct = distinct_ids(all);
    ids = distinct.ids;
    first = distinct.places;
    if (count() == received.count()) {  // no id came twice: each has its place
      parallel_for("GALE::number_received", HostExecutionSpace(), count(),
                   [&](Offset i) { number_[first(i)] = static_cast<Id>(i); });
      return;
    }
    const GlobalIndex index(ids);
    parallel_for("GALE::number_received", HostExecutionSpace(), received.count(),
                 [&](Offset i) { number_[i] = index.find(all(i)); });
  }

  Id count() const { return static_cast<Id>(ids.extent(0)); }

  /// The number of what a rank has sent at a place.
  Id of(int rank, Id place) const { return number_[begin_[rank] + place]; }

  /// Numbers by rank.
  const std::vector<Offset>& begin() const { return begin_; }
  Id operator[](Offset i) const { return number_[i]; }

  GlobalIds ids;                ///< by number
  Array<Id, HostMemory> first;  ///< where among what was received each is first

 private:
  std::vector<Offset> begin_;
  std::vector<Id> number_;
};

/// The corners of cells that ranks have sent, by the numbers of their vertices.
template <int corners>
CellCorners<corners, Id, HostMemory> received_corners(const ReceivedNumbers<ReceivedVertex>& vertices,
                                                      const ReceivedNumbers<ReceivedCell>& cells,
                                                      const EntriesByRank<ReceivedCell>& received) {
  const auto rows =
      allocate<typename CellCorners<corners, Id, HostMemory>::non_const_type>("GALE::received_cells", cells.count());
  parallel_for("GALE::received_cells", HostExecutionSpace(), cells.count(), [&](Offset t) {
    const Id at = cells.first(t);
    const int rank = received.rank_of(at);
    for (int k = 0; k < corners; ++k) rows(t, k) = vertices.of(rank, received.entries(at).corners[k]);
  });
  return rows;
}

}  // namespace gale::detail
