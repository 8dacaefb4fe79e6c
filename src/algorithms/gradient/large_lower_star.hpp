#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/gradient/heap_queues.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// A LowerStar with its queues, for stars of any size, and triangles with any number of tetrahedra. Time O(n log n).
/// One serves one thread, and keeps its memory.
class LargeLowerStar : public HeapQueues {
 public:
  static constexpr Id no_place = no_id;
  static constexpr bool may_fork = true;   ///< whether a triangle may have more than two tetrahedra
  static constexpr bool may_leave = true;  ///< or only one

  /// `ranks`: of all neighbours, no_id for an upper one; `numbers(place)`: the number of each tetrahedron of the star.
  template <class Numbers>
  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link, const Numbers& numbers) {
    numbers_.resize(link.size());
    for (Id t = 0; t < link.size(); ++t) numbers_[t] = numbers(t);
    build(ranks, edges, link);
  }

  int dimension(int cell) const { return corners_[cell][1] < 0 ? 1 : corners_[cell][2] < 0 ? 2 : 3; }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  const std::array<Id, 3>& corners(int cell) const { return corners_[cell]; }

  /// Place of a tetrahedron in the VT row.
  Id place(int tetrahedron) const { return place_[tetrahedron]; }

  /// Place in the VT row of a triangle's tetrahedron that isn't the one at `place`, of several that of the lowest
  /// number; `no_place` if there is no other.
  Id across(int triangle, Id place) const;

  /// Calls visit(place) for the places in the VT row of a triangle's tetrahedra.
  template <class Visit>
  void for_each_tetrahedron(int triangle, const Visit& visit) const {
    for (auto side = first_side(triangle); is_side(side, triangle); ++side) visit((*side)[2]);
  }

 private:
  using Corners = std::array<Id, 3>;

  void build(const std::vector<Id>& ranks, int edges, const LinkRow& link);
  int cell_of(const Corners& corners) const;
  std::vector<Corners>::const_iterator first_side(int triangle) const;
  bool is_side(std::vector<Corners>::const_iterator side, int triangle) const {
    return side != sides_.end() && (*side)[0] == corners_[triangle][0] && (*side)[1] == corners_[triangle][1];
  }
  void find_facets();

  std::vector<Id> numbers_;       ///< of the star's tetrahedra
  std::vector<Corners> sides_;    ///< each triangle's two ranks and each of its tetrahedra's place, ascending
  std::vector<Corners> corners_;  ///< of each cell, ascending in lexicographic order; -1 where it has no more
  std::vector<Id> place_;
};

}  // namespace gale::detail
