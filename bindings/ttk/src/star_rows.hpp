#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/ttk/block_store.hpp>
#include <gale/ttk/segments.hpp>

namespace gale::ttk {

/// Stars and neighbours of a segment's vertices in the caller's ids and in TTK's order, straight from the caller's
/// cells: these are sorted once for the segment, so that no star is. What the host does where no device makes stars.
/// One serves one thread, for one segment after the other, and keeps its memory. O(n) in the segment's cells.
class StarRows {
 public:
  /// Cells must be grouped.
  StarRows(const Segments& segments, const Cells& cells) : segments_(segments), cells_(cells) {}

  /// Finds the stars of a segment's vertices; at once if it did so the last time.
  void find(Id segment);

  /// The cells of each vertex, ascending.
  Block stars() const;

  /// The neighbours of each vertex in the order of the edges to them: the order in which one meets them in the cells of
  /// its star, and in each cell as the caller has its corners.
  Block neighbours();

  /// The vertices that have a facet with one cell only, in the caller's ids; after neighbours().
  const std::vector<Id>& on_surface() const { return on_surface_; }

 private:
  /// A cell's corners as the caller has them: rows of the segment, or numbers of other vertices.
  using Corners = std::array<Id, 4>;  // of a triangle three

  void number_corners();
  void place_cells();
  template <int corners>
  Id* add_neighbours(Id row, Id* to);
  bool is_on_surface(Id row, Id neighbours);

  const Segments& segments_;
  const Cells cells_;

  Id segment_ = no_id, first_ = 0, rows_ = 0;
  std::vector<Id> near_, unsorted_;    ///< the cells that touch the segment, ascending
  std::vector<Corners> corners_;       ///< of each of them
  std::vector<Id> vertices_;           ///< row or number -> the caller's id
  HashTable<Id> outside_;              ///< vertices that other segments hold (the caller's ids) -> their numbers
  std::vector<Id> star_begin_, star_;  ///< row -> places in near_, ascending

  /// Where the row that is made has each vertex (by number, with the row above, so that nothing is cleared between
  /// rows), and what link there is.
  std::vector<std::uint64_t> met_;
  std::vector<Id> places_;             ///< in the row, of the other vertices of each cell
  std::vector<std::uint64_t> parity_;  ///< by place: bits of those with which it shares an odd number of link
                                       ///< triangles, or whether it has an odd number of link edges
  std::vector<Id> words_;
  std::vector<Id> on_surface_;
  gale::detail::LargeLink large_;
};

}  // namespace gale::ttk
