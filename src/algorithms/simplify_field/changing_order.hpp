#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/csr.hpp>

namespace gale::detail {

/// Vertices that come right after another one in a changed order, or right before it.
struct FilledBranch {
  Id saddle;                 ///< GALE's vertex that ends the branch
  std::vector<Id> vertices;  ///< the branch's own, as the side comes to them that ends with the saddle
};

/// Memory that changing an order takes again and again.
struct ChangingRoom {
  explicit ChangingRoom(Id vertices)
      : vertices_before(allocate<Array<Id, HostMemory>>("GALE::vertices_before", vertices)),
        places(allocate<Array<Id, HostMemory>>("GALE::new_places", vertices + Offset(1))) {}

  Array<Id, HostMemory> vertices_before;  ///< by rank
  Array<Id, HostMemory> places;           ///< one more than there are vertices
};

/// An order of a mesh's vertices that changes, and its extremum graph. All vertices are GALE's.
class ChangingOrder {
 public:
  /// By a sweep.
  ChangingOrder(Structure& structure, const VertexOrder& order, const SweepOptions& options);

  const std::uint64_t* keys() const { return rank_.data(); }
  const ExtremumGraph<HostMemory>& graph() const { return graph_; }

  /// The vertex whose value each has.
  const std::vector<Id>& value_of() const { return value_of_; }

  /// Fills branches of one side: gives each vertex the value of its saddle and a new place, and finds the graph of what
  /// has changed. Branches of one saddle are filled one after the other.
  void fill(Side side, std::vector<FilledBranch> branches, ChangingRoom& room);

 private:
  void gather_rows(const std::vector<FilledBranch>& branches);
  void flood(Side side, FilledBranch& branch, Id number);
  void reorder(Side side, const std::vector<FilledBranch>& branches, ChangingRoom& room);
  void update_graph();

  Structure& structure_;
  const int threads_;
  Array<std::uint64_t, HostMemory> rank_;  ///< of each vertex
  Array<Id, HostMemory> by_rank_;
  std::vector<Id> value_of_;
  ExtremumGraph<HostMemory> graph_;

  // While branches are filled: the vertices that change, ascending, and their neighbours.
  std::vector<Id> changed_;
  std::vector<Offset> row_begin_;
  std::vector<Id> rows_;
  std::vector<Offset> link_begin_;  ///< words
  std::vector<Id> links_;           ///< the places of each link, from a new word on
  std::vector<LinkRow> shapes_;     ///< of links, without their places
  std::vector<Id> place_;           ///< of each vertex among them; no_id
  std::vector<Id> branch_;  ///< of each that changes the number of its branch; no_id for saddles and what was flooded
};

}  // namespace gale::detail
