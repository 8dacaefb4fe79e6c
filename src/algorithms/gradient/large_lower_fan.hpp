#pragma once

#include <array>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/heap_queues.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The lower star of a vertex of a triangle mesh with its queues, for stars of any size, and edges with any number of
/// triangles. Its cells but the vertex are numbered in the order of their keys, and vertices are named by their ranks
/// among the lower neighbours, as in LowerStar. Time O(n log n). One serves one thread, and keeps its memory.
class LargeLowerFan : public HeapQueues {
 public:
  /// `ranks`: of all neighbours, no_id for an upper one; `numbers(place)`: the number of each triangle of the star.
  template <class Numbers>
  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link, const Numbers& numbers) {
    numbers_.resize(link.size());
    for (Id t = 0; t < link.size(); ++t) numbers_[t] = numbers(t);
    build(ranks, edges, link);
  }

  /// Whether a cell is an edge; else it is a triangle.
  bool is_edge(int cell) const { return cells_[cell].b < 0; }

  /// The rank of a cell's highest vertex but the star's own.
  Id high(int cell) const { return cells_[cell].a; }

  /// Place of a triangle in the VF row.
  Id place(int triangle) const { return cells_[triangle].place; }

  /// Place in the VF row of an edge's triangle that isn't the one at `place`, of several that of the lowest number;
  /// no_id if there is no other.
  Id across(int edge, Id place) const;

  /// Calls visit(place) for the places in the VF row of an edge's triangles.
  template <class Visit>
  void for_each_triangle(int edge, const Visit& visit) const {
    const Id a = high(edge);
    for (Id i = side_begin_[a]; i < side_begin_[a + 1]; ++i) visit(sides_[i].second);
  }

 private:
  /// An edge, or a triangle, by the ranks of its other vertices, descending; b is -1 of an edge.
  struct Cell {
    Id a, b, place;

    friend bool operator<(const Cell& one, const Cell& other) {
      return one.a < other.a || (one.a == other.a && one.b < other.b);
    }
  };

  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link);

  std::vector<Id> numbers_;               ///< of the star's triangles
  std::vector<Cell> cells_;               ///< ascending
  std::vector<std::pair<Id, Id>> sides_;  ///< each edge's rank and the place of each of its triangles, ascending
  std::vector<Id> side_begin_;            ///< where those of each edge begin
};

}  // namespace gale::detail
