#pragma once

#include <array>
#include <functional>
#include <queue>
#include <vector>

#include <gale/relations/rows.hpp>

namespace gale::detail {

/// A LowerStar with its queues, for stars of any size, among tetrahedra or triangles, and facets of these that any
/// number of them share: a facet is a triangle or, on a triangle mesh, an edge. Time O(n log n). One serves one thread,
/// and keeps its memory.
class LargeLowerStar {
 public:
  static constexpr Id no_place = no_id;
  static constexpr bool may_fork = true;   ///< whether a facet may have more than two of the mesh's cells
  static constexpr bool may_leave = true;  ///< or only one

  /// `ranks`: of all neighbours, no_id for an upper one; `numbers(place)`: the number of each of the mesh's cells in
  /// the star.
  template <class Numbers>
  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link, const Numbers& numbers) {
    numbers_.resize(link.size());
    for (Id t = 0; t < link.size(); ++t) numbers_[t] = numbers(t);
    build(ranks, edges, link);
  }

  int dimension(int cell) const { return corners(cell)[1] < 0 ? 1 : corners(cell)[2] < 0 ? 2 : 3; }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  const std::array<Id, 4>& corners(int cell) const { return cells_[cell]; }

  /// Place of one of the mesh's cells in the VT, or VF, row.
  Id place(int cell) const { return cells_[cell][3]; }

  /// Place of a facet's cell that isn't the one at `place`, of several that of the lowest number; `no_place` if there
  /// is no other.
  Id across(int facet, Id place) const;

  /// Calls visit(place) for the places of a facet's cells.
  template <class Visit>
  void for_each_place(int facet, const Visit& visit) const {
    for (Id i = side_begin_[facet]; i < side_begin_[facet + 1]; ++i) visit(sides_[i][3]);
  }

  // The queues of `pair_cells`: cells are numbered in the order of their keys.

  void add_edges() {
    for (int cell = 1; cell < static_cast<int>(facets_.size()); ++cell) {
      if (facets_[cell][0] < 0) deferred_.push(cell);
    }
  }
  void settle(int cell) { settled_[cell] = true; }
  void push(int cell);
  bool next(int& cell) { return take(ready_, cell); }
  bool next_deferred(int& cell) { return take(deferred_, cell); }
  void defer(int cell) { deferred_.push(cell); }
  int facet(int cell) const;

 private:
  using Queue = std::priority_queue<int, std::vector<int>, std::greater<int>>;

  /// The ranks of a cell, -1 where there are fewer than three, and its place if it is one of the mesh's, else no_id; or
  /// those of a facet, and the place of a cell that has it.
  using Ranked = std::array<Id, 4>;

  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link);
  void find_sides(const std::vector<Id>& ranks, const LinkRow& link);
  int triangle(Id a, Id b) const;

  /// When the facets are set: finds the cofacets, and empties the queues.
  void connect();
  bool take(Queue& from, int& cell);

  std::vector<Id> numbers_;     ///< of the mesh's cells
  std::vector<Ranked> cells_;   ///< ascending
  std::vector<Ranked> sides_;   ///< each facet with each of its cells, ascending
  std::vector<Id> side_begin_;  ///< where those of each cell begin
  std::vector<int> edge_cell_;  ///< by rank

  /// The facets of each cell that contain the vertex, -1 where there are fewer than three: those of edges contain
  /// nothing else, and aren't there.
  std::vector<std::array<int, 3>> facets_;
  std::vector<int> cofacet_begin_;
  std::vector<int> cofacets_;
  std::vector<char> settled_;
  Queue ready_, deferred_;
};

}  // namespace gale::detail
