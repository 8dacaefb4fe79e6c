#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/baselines/lower_triangles.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// A priority queue of numbers from 0 on, the least first. Each is in it once or not at all. It has a bit for each
/// number. Above them is a level with a bit for each word of 64 bits, set if that word isn't 0, and so on up to a
/// single word. To push and to pop takes a step for each level. One serves one thread, and keeps its memory.
class KeyQueue {
 public:
  /// Makes room for numbers below `bound`. The queue must be empty.
  void begin(std::size_t bound) {
    for (levels_ = 0; bound > 64; ++levels_) {
      bound = (bound + 63) / 64;
      if (levels_ == static_cast<int>(words_.size())) words_.emplace_back();
      if (words_[levels_].size() < bound) words_[levels_].resize(bound, 0);
    }
  }

  bool empty() const { return top_ == 0; }

  void push(int number) {
    for (int level = 0; level < levels_; ++level) {
      words_[level][number >> 6] |= bit(number);
      number >>= 6;
    }
    top_ |= bit(number);
  }

  /// Takes the least one; there is one.
  int pop() {
    int least = lowest_bit(top_);
    for (int level = levels_ - 1; level >= 0; --level) least = 64 * least + lowest_bit(words_[level][least]);
    remove(least);
    return least;
  }

 private:
  static std::uint64_t bit(int number) { return std::uint64_t(1) << (number & 63); }

  void remove(int number) {
    for (int level = 0; level < levels_; ++level) {
      std::uint64_t& word = words_[level][number >> 6];
      word &= ~bit(number);
      if (word != 0) return;
      number >>= 6;
    }
    top_ &= ~bit(number);
  }

  std::uint64_t top_ = 0;
  int levels_ = 0;                                 ///< below it
  std::vector<std::vector<std::uint64_t>> words_;  ///< by level; all 0 when it is empty
};

/// The lower star of a vertex, made from its edges, triangles and tetrahedra, with priority queues for `pair_cells`.
/// Its cells but the vertex are numbered in the order of their keys: the ranks of their lower vertices, descending,
/// compared lexicographically. Stars of any size, and triangles with any number of tetrahedra. One serves one thread,
/// and keeps its memory.
class QueuedLowerStar {
 public:
  using Corners = std::array<Id, 3>;

  // To make one: `begin`, all triangles, `end_triangles`, all tetrahedra, `end`. They are given by the ranks of their
  // other vertices; those of upper vertices are below 0.

  /// Begins a lower star with `edges` edges, whose ranks are 0 to edges - 1, in a star of so many triangles and
  /// tetrahedra.
  void begin(Id edges, Id triangles, Id tetrahedra);
  void add_triangle(Id a, Id b) { triangles_.add(a, b); }
  void end_triangles();

  /// a > b > c, where they aren't below 0. Without a branch, which no processor could predict.
  void add_tetrahedron(Id a, Id b, Id c, Id tetrahedron) {
    inner_[inner_count_] = {a, b, c, tetrahedron, {}};
    outer_[outer_count_] = {a, b, tetrahedron};
    inner_count_ += c >= 0;
    outer_count_ += (b >= 0) & (c < 0);
  }
  void end();

  int dimension(int cell) const { return cells_[cell].corners[1] < 0 ? 1 : cells_[cell].corners[2] < 0 ? 2 : 3; }

  /// Ranks of a cell's vertices, descending; as many as it has dimensions.
  const Corners& corners(int cell) const { return cells_[cell].corners; }

  /// Id of a cell that is a tetrahedron.
  Id tetrahedron(int cell) const { return inner_[cells_[cell].place].id; }

  /// The other tetrahedron of a triangle; of several that of the lowest number, no_id if there is none.
  Id across(int triangle, Id tetrahedron, const OtherIds& numbers) const;

  /// Calls visit(tetrahedron) for each that a triangle has, in the lower star or not.
  template <class Visit>
  void for_each_tetrahedron(int triangle, const Visit& visit) const {
    for (int i = sides_of_[cells_[triangle].place].sides; i >= 0; i = sides_[i].next) visit(sides_[i].to);
  }

  // The queues.
  void add_edges() {
    for (std::size_t a = 1; a < edge_cell_.size(); ++a) deferred_.push(edge_cell_[a]);
  }

  /// Queues what `push` is to queue already: each cofacet loses an unsettled facet here, and no cell that is settled
  /// between this and the push has the same cofacet.
  void settle(int cell);
  void push(int) {}
  bool next(int& cell) { return take(ready_, cell); }
  bool next_deferred(int& cell) { return take(deferred_, cell); }
  void defer(int cell) { deferred_.push(cell); }
  int facet(int cell) const { return cells_[cell].open == 0 ? -1 : cells_[cell].left; }

 private:
  /// An element of one cell's list.
  struct Link {
    Id to;
    int next;
  };

  struct Cell {
    Corners corners;
    int place;     ///< a triangle's or a tetrahedron's, in `sides_of_` or `inner_`
    int open;      ///< how many facets are unsettled; below 0 once the cell itself is settled
    int left;      ///< exclusive or of these facets: if there is one, that facet
    int cofacets;  ///< the first link to them, or -1
  };

  struct Triangle {
    int cell;
    int tetrahedra;  ///< how many of the lower star have a lower third vertex
    int sides;       ///< the first link to any of its tetrahedra, or -1
  };

  struct Tetrahedron {
    Id a, b, c;
    Id id;
    Id triangles[3];  ///< (a, b), (a, c) and (b, c)
  };

  struct Side {
    Id a, b;
    Id id;
  };

  static constexpr int settled = -4;  ///< less than the facets of a cell

  void find_sides();
  void number_cells();
  void place_tetrahedra();
  void connect();
  void add_side(Id triangle, Id tetrahedron);
  void add_facet(int cell, int facet);
  bool take(KeyQueue& from, int& cell);

  LowerTriangles triangles_;
  std::vector<Triangle> sides_of_;  ///< by triangle
  std::vector<Tetrahedron> inner_;  ///< in the lower star, with room for one more
  std::vector<Side> outer_;         ///< with one upper vertex; likewise
  int inner_count_ = 0, outer_count_ = 0;
  std::vector<Link> sides_;
  std::vector<Cell> cells_;
  std::vector<int> edge_cell_, tetrahedron_cell_;
  std::vector<Link> cofacets_;
  int side_count_ = 0, cell_count_ = 0, cofacet_count_ = 0;
  KeyQueue ready_, deferred_;
};

inline void QueuedLowerStar::settle(int cell) {
  cells_[cell].open = settled;
  for (int i = cells_[cell].cofacets; i >= 0; i = cofacets_[i].next) {
    Cell& cofacet = cells_[cofacets_[i].to];
    cofacet.left ^= cell;
    if (--cofacet.open == 1) ready_.push(cofacets_[i].to);
  }
}

inline bool QueuedLowerStar::take(KeyQueue& from, int& cell) {
  while (!from.empty()) {
    cell = from.pop();
    if (cells_[cell].open >= 0) return true;
  }
  return false;
}

}  // namespace gale::detail
