#pragma once

#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// A triangle of a wall; (high, low) is the edge that it is paired with, unless it is the critical one.
struct WallTriangle {
  Id high, low, third;
  Id wall;
};

/// A critical edge that a wall ends at.
struct WallRim {
  Id wall;
  Id high, low;
};

/// What kernels read of a discrete gradient that kernels found, to follow walls through it.
struct GradientRows {
  const Id* pair_words;
  const Offset* pairs_begin;
  const Id* vertex_successor;
  const std::uint64_t* keys;
  const Id* vertex_input;

  /// The number of an edge among all edges: the place of its word.
  KOKKOS_FUNCTION Offset number(Id high, Id place) const { return pairs_begin[high] + 1 + place; }

  KOKKOS_FUNCTION EdgePairRow row(Id high) const {
    return EdgePairRow(const_cast<Id*>(pair_words) + pairs_begin[high]);  // which it only reads
  }

  /// Is one triangle before another, both written with their input vertices ascending?
  KOKKOS_FUNCTION bool is_less(const WallTriangle& a, const WallTriangle& b) const {
    const Written first(vertex_input, a), second(vertex_input, b);
    if (first.least != second.least) return first.least < second.least;
    if (first.middle != second.middle) return first.middle < second.middle;
    return first.most < second.most;
  }

 private:
  struct Written {
    Id least, middle, most;

    KOKKOS_FUNCTION Written(const Id* input, const WallTriangle& triangle)
        : least(input[triangle.high]), middle(input[triangle.low]), most(input[triangle.third]) {
      in_order(least, middle);
      in_order(middle, most);
      in_order(least, middle);
    }
    KOKKOS_FUNCTION static void in_order(Id& a, Id& b) {
      if (a <= b) return;
      const Id greater = a;
      a = b;
      b = greater;
    }
  };
};

/// How many a kernel has found so far.
struct WallCounts {
  Offset triangles = 0, edges = 0, rims = 0;
};

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  WallTable table;
  Array<WallTriangle, WorkerMemory> triangles;  ///< the critical ones first
  Array<WallRim, WorkerMemory> rims;
  Array<WallCounts, WorkerMemory> counts;  ///< one
};

/// The descending walls of some critical triangles of a gradient that kernels found. They grow side by side where the
/// gradient is: a layer of triangles at a time, each across the edges that it isn't paired with. So there are as many
/// launches as the deepest wall has layers; time and memory grow with all walls together.
class GrowingWalls {
 public:
  /// Refers to the gradient.
  GrowingWalls(const WorkerSpace& space, const DiscreteGradient& gradient);

  /// Makes the walls of `critical`, each given by its vertices from the highest to the lowest. Throws OutOfMemory, also
  /// if they would have more than `most_triangles`.
  void grow(const TriangleVertices* critical, Id count, Offset most_triangles);

  /// How many walls a call can make at most.
  Id most_walls() const;

  /// The critical edges that they end at, in no order.
  std::vector<WallRim> rims() const;

  /// Appends the path from each of these rims up to the wall's critical triangle, which it includes: see `connectors`
  /// of MorseSmaleComplex. Sources and destinations are the caller's.
  void append_paths(const std::vector<WallRim>& from, Separatrices<TriangleVertices>& paths) const;

 private:
  void begin(const TriangleVertices* critical, Id count);
  void reserve(Offset layer, Offset most_triangles);
  void read_counts();

  WorkerSpace space_;
  GradientRows gradient_;
  int edge_bits_;
  WallSink found_;
  Id walls_ = 0;
  WallCounts counts_;
};

}  // namespace gale::detail
