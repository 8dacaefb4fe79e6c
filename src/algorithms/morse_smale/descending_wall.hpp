#pragma once

#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/separatrices.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

/// The surface that a critical triangle's falling paths sweep: from a triangle across each of its edges to the triangle
/// that the edge is paired with. One serves one thread, for one wall after the other, and keeps its memory.
class DescendingWall {
 public:
  struct Edge {
    Id high, low;
  };

  explicit DescendingWall(const DiscreteGradient& gradient);

  /// Finds the wall of a critical triangle, which is given by its vertices from the highest to the lowest. Time and
  /// memory grow with the wall.
  void follow(const TriangleVertices& critical);

  /// Its triangles, breadth first, the critical one first. The first two vertices of each other triangle are the edge
  /// that it is paired with, the higher vertex first.
  const std::vector<TriangleVertices>& triangles() const { return triangles_; }

  /// The critical edges of its rim.
  const std::vector<Edge>& critical_edges() const { return critical_edges_; }

  /// Appends the path inside the wall that rises from one of its critical edges to the critical triangle: the
  /// triangles, the last one included. Where several triangles of the wall meet at an edge, it takes the one that is
  /// least, written with its input vertices ascending. True if they never do: then it is the only path.
  bool append_path(const Edge& from, std::vector<TriangleVertices>& path) const;

 private:
  /// An edge of the wall: the least of the wall's triangles that it isn't paired with, by its place among them, and
  /// whether there are more.
  struct Above {
    std::uint32_t least = 0;
    bool are_several = false;
  };

  void cross(Id high, Id low, std::uint32_t from);
  bool is_less(const TriangleVertices& a, const TriangleVertices& b) const;

  const EdgePairs& pairs_;
  const Id* vertex_successor_;
  const std::uint64_t* keys_;
  const Id* vertex_input_;
  std::vector<TriangleVertices> triangles_;
  std::vector<Edge> critical_edges_;
  HashTable<Above> above_;
};

}  // namespace gale::detail
