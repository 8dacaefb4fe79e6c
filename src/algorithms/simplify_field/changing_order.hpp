#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/algorithms/simplify_field/changed_stars.hpp>
#include <gale/algorithms/vertex_order.hpp>

namespace gale::detail {

/// Vertices that come right after another one in a changed order, or right before it.
struct FilledBranch {
  Id saddle;                 ///< GALE's vertex that ends the branch
  std::vector<Id> vertices;  ///< the branch's own, as the side comes to them that ends with the saddle
};

/// Memory that changing an order takes again and again: two arrays of one more entry than there are vertices.
template <class Memory>
struct ChangingRoom {
  explicit ChangingRoom(Id vertices)
      : vertices_before(allocate<Array<Id, Memory>>("GALE::vertices_before", vertices + Offset(1))),
        places(allocate<Array<Id, Memory>>("GALE::new_places", vertices + Offset(1))) {}

  Array<Id, Memory> vertices_before;  ///< by rank
  Array<Id, Memory> places;
};

/// An order of a mesh's vertices that changes, and its extremum graph. All vertices are GALE's. What all vertices have
/// lies where `Space` runs; the few that change are flooded on the host.
template <class Space>
class ChangingOrder {
 public:
  using Memory = MemoryOf<Space>;

  /// From the order's graph. `stars` reads what changes.
  ChangingOrder(const Space& space, const VertexOrder& order, ExtremumGraph<Memory> graph, ChangedStars stars,
                int threads);

  const Space& space() const { return space_; }
  const ExtremumGraph<Memory>& graph() const { return graph_; }

  /// The keys where `Space` runs.
  const std::uint64_t* keys() const { return rank_.data(); }

  /// The keys of some vertices.
  std::vector<std::uint64_t> keys_of(const std::vector<Id>& some) const;

  /// The vertex whose value each has.
  const Array<Id, HostMemory>& value_of() const { return value_of_; }

  /// Fills branches of one side: gives each vertex the value of its saddle and a new place, and finds the graph of what
  /// has changed. Branches of one saddle are filled one after the other.
  void fill(Side side, std::vector<FilledBranch> branches, ChangingRoom<Memory>& room);

 private:
  const std::uint64_t* keys_on_host(const std::vector<Id>& of);
  void flood(const SideKeys& keys, FilledBranch& branch, Id number);
  void reorder(Side side, const std::vector<FilledBranch>& branches, ChangingRoom<Memory>& room);
  void update_graph();

  const Space space_;
  const int threads_;
  Array<std::uint64_t, Memory> rank_;  ///< of each vertex
  Array<Id, Memory> by_rank_;          ///< one more than there are vertices
  Array<Id, HostMemory> value_of_;
  ExtremumGraph<Memory> graph_;
  ZeroedRoom<std::uint64_t> known_;  ///< what the host was told of `rank_`, where it can't read that

  ChangedStars stars_;
  std::vector<Id> branch_;  ///< of each that changes the number of its branch; no_id for saddles and what was flooded
};

}  // namespace gale::detail
