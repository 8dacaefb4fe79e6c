#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// The tetrahedra and triangles of an edge. One serves one thread, for one edge after the other, and keeps its memory.
class EdgeStar {
 public:
  explicit EdgeStar(const Mesh& mesh);

  /// Finds those of the edge between `low` and `high`, whose VT row this is. Time O(k log k) in the number k of the
  /// edge's tetrahedra, and beside that: O(1) while the row is short, else O(log n) in its length n. The first edge at
  /// a vertex with a long row takes O(n log n), and 24 bytes an entry of the row, which are kept.
  void find(Id high, Id low, const Row& tetrahedra);

  /// The third vertices of its triangles, ascending.
  const std::vector<Id>& thirds() const { return thirds_; }

  /// Its tetrahedra in their order around it. From an end if there is one, else from that of the lowest input id; of
  /// the two ends and of the two ways that of the lower input id. Where a triangle has three and more tetrahedra, some
  /// order that depends on the input alone.
  const std::vector<Id>& around() const { return around_; }

 private:
  /// A tetrahedron and its two triangles at the edge, by their places in `thirds_`.
  struct Wedge {
    Id input, tetrahedron;
    int sides[2];
    bool taken;
  };

  /// Pairs (other vertex, tetrahedron) of the star of a vertex, ascending.
  using VertexStar = std::vector<std::uint64_t>;

  const VertexStar& star_of(Id vertex, const Row& tetrahedra);
  void add_wedge(Id tetrahedron);
  void find_thirds(Id high, Id low);
  void go_around();
  void go_from(int wedge);
  void take(int wedge);
  bool is_end(const Wedge& wedge) const;
  int next(int side);

  Mesh mesh_;
  CellReader cell_;
  OtherIds cell_input_;
  std::unordered_map<Id, VertexStar> long_stars_;
  std::vector<Wedge> wedges_;            ///< by input id
  std::vector<std::uint64_t> at_sides_;  ///< pairs (third vertex, wedge), ascending
  std::vector<int> side_begin_;          ///< where each side's pairs begin
  std::vector<int> side_next_;           ///< the first pair of each side whose wedge may not be taken yet
  std::vector<Id> thirds_, around_;
};

}  // namespace gale::detail
