#pragma once

#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/wider_successors.hpp>
#include <gale/algorithms/persistence/turned_gradient.hpp>
#include <gale/algorithms/separatrices.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

/// What walls read of a gradient. Refers to it.
struct WallGround {
  const EdgePairs& pairs;
  WiderSuccessorsOf<VertexSteps> vertex_successor;
  NamedKeys keys;
  VertexNames vertex_names;  ///< compare as input ids do
  Interval owned;  ///< edges whose higher end isn't one of these have no pairs here: they are where walls leave
};

/// What walls read of a gradient by itself.
WallGround ground_of(const DiscreteGradient& gradient);

/// The surface that a critical triangle's falling paths sweep: from a triangle across each of its edges to the triangle
/// that the edge is paired with. One serves one thread, for one wall after the other, and keeps its memory.
class DescendingWall {
 public:
  struct Edge {
    Id high, low;
  };

  /// With `turned` in the gradient that these edges make of it; it may change between walls.
  explicit DescendingWall(const WallGround& ground, const TurnedEdges* turned = nullptr);

  /// Finds the wall of a critical triangle, which is given by its vertices from the highest to the lowest. Time and
  /// memory grow with the wall.
  void follow(const TriangleVertices& critical);

  /// A wall as far as it was followed: triangles and the edges of its rim that are critical, or other ranks follow on.
  struct Part {
    std::vector<TriangleVertices> triangles;
    std::vector<Edge> critical_edges, exits;
  };
  Part part() const { return {triangles_, critical_edges_, exits_}; }

  /// Goes on with a wall from its exits, on a ground where vertices have the same ids as on the one where it was
  /// followed. Its triangles come in another order than `follow` has, which `count_paths` relies on.
  void follow_on(Part part);

  /// Finds as much of the wall as it takes to meet a critical edge, if it is in the wall: whether it is. Looks at no
  /// edge below that one if `above_it`.
  bool follow_to(const TriangleVertices& critical, const Edge& edge, bool above_it);

  /// Its triangles, breadth first, the critical one first. The first two vertices of each other triangle are the edge
  /// that it is paired with, the higher vertex first.
  const std::vector<TriangleVertices>& triangles() const { return triangles_; }

  /// The critical edges of its rim.
  const std::vector<Edge>& critical_edges() const { return critical_edges_; }

  /// The edges of its rim that `turned` pairs with vertices.
  const std::vector<Edge>& cancelled_edges() const { return cancelled_edges_; }

  /// The edges of its rim that other ranks follow on.
  const std::vector<Edge>& exits() const { return exits_; }

  /// Finds out which triangles one path alone leads to, for `paths_from`.
  void count_paths();

  /// How many paths rise from an edge to the critical triangle: 0, 1, or 2 for more. The edge need not be critical.
  /// After `follow` and `count_paths`.
  int paths_from(const Edge& edge) const;

  /// Appends the path inside the wall that rises from one of its critical edges to the critical triangle: the
  /// triangles, the last one included. Where several triangles of the wall meet at an edge, it takes the one that is
  /// least, written with its input vertices ascending; if they never do, it is the only path. With Paths::joined it is
  /// appended as far as the first triangle of a path that was so appended since `follow`, if it joins one.
  struct Appended {
    bool is_only, joins;
  };
  Appended append_path(const Edge& from, std::vector<TriangleVertices>& path, Paths told = Paths::whole);

 private:
  /// An edge of the wall: the least of the wall's triangles that it isn't paired with, by its place among them, and
  /// whether there are more.
  struct Above {
    std::uint32_t least = 0;
    bool are_several = false;
  };

  void begin(const TriangleVertices& critical);
  void follow_from(std::size_t triangle);
  void prefetch(const TriangleVertices& triangle) const;
  void cross_sides(std::uint32_t triangle);
  template <class Visit>
  void for_each_side(std::uint32_t triangle, const Visit& visit) const;
  bool reach(Id high, Id low, std::uint32_t from);
  void cross(Id high, Id low, std::uint32_t from);
  void go_on(Id high, Id low);
  Id third_of(Id high, Id low) const;
  bool is_less(const TriangleVertices& a, const TriangleVertices& b) const;

  const WallGround ground_;
  const TurnedEdges* turned_;
  std::uint64_t floor_ = 0;  ///< edges with a lower higher end are left out
  std::vector<TriangleVertices> triangles_;
  std::vector<char> has_one_path_;  ///< of each triangle
  std::vector<char> passed_;        ///< of each: an appended path is there
  std::vector<Edge> critical_edges_, cancelled_edges_, exits_;
  HashTable<Above> above_;
};

}  // namespace gale::detail
