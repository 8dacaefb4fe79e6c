#pragma once

#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/algorithms/separatrices.hpp>

namespace gale::detail {

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  WallTable table;
  Array<WallTriangle, WorkerMemory> triangles;  ///< the critical ones first
  Array<WallRim, WorkerMemory> rims;
  Array<Offset, WorkerMemory> counts;  ///< triangles, edges, critical edges
};

/// The descending walls of some critical triangles of a gradient that kernels found. They grow side by side where the
/// gradient is: a layer of triangles at a time, each across the edges that it isn't paired with. So there are as many
/// launches as the deepest wall has layers; time and memory grow with all walls together.
class GrowingWalls {
 public:
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
  void cross(Offset begin, Offset end);
  void read_counts();

  WorkerSpace space_;
  EdgesInMemory gradient_;
  int word_bits_;
  WallSink found_;
  Id walls_ = 0;
  Offset triangles_ = 0, edges_ = 0, rims_ = 0;
};

}  // namespace gale::detail
