#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/gradient/edges_in_kernels.hpp>
#include <gale/base/bit_table.hpp>
#include <gale/base/launch_chain.hpp>

namespace gale::detail {

/// An edge that falls, the higher end first, and the third vertex of the triangle that it is paired with, or
/// edge_is_critical.
struct FallenEdge {
  Id high, low, third;
};

/// How many edges kernels have passed, those that they have left to other ranks, some more than once, since fall() was
/// called, and those that threads have left open, for launches to go on from in this order.
struct FallenCounts {
  Offset passed = 0, left = 0, open = 0;
  LaunchPart part;
};

/// Where kernels put edges that fall. Copies share it.
struct FallenEdges {
  BitTable passed;
  Array<FallenEdge, WorkerMemory> open;
  Array<std::array<Id, 2>, WorkerMemory> left;
  Array<FallenCounts, WorkerMemory> counts;  ///< one
};

/// Edges that fall along a gradient that kernels found: from one that is paired with a triangle to the other edges of
/// that triangle, and so on. Each is passed once. A thread goes some steps down one way after the other, and leaves the
/// rest to the next launch. Takes a bit for each number of an edge in the workers' memory (14 a vertex of a grid), and
/// 20 bytes for each edge that is left open or to others; where there is room up to 340 for each of those that it
/// begins with, or 0.7 MB for few of them; 42 MB at most to begin with where many are expected. Refers to the gradient.
class FallingEdges {
 public:
  /// Begins with room for about as many open edges as all walls have, if these are to be expected. Throws OutOfMemory.
  FallingEdges(const DiscreteGradient& gradient, bool expects_all);

  /// Lets some edges fall, the higher ends first, and all that they come to. Returns those of these that are other
  /// ranks' to follow: in the calls before perhaps, too. Throws OutOfMemory, and is of no use then.
  std::vector<std::array<Id, 2>> fall(const std::vector<std::array<Id, 2>>& edges);

  /// The edges that were passed; none of those that are paired with vertices, or other ranks' to follow.
  std::vector<std::array<Id, 3>> passed() const;

 private:
  void reserve(Offset threads);
  void make_room_for(Offset more, Offset least);

  const WorkerSpace space_{};
  const EdgesInKernels edges_;
  const Offset expected_;
  const Array<const std::uint64_t, WorkerMemory> keys_;
  Array<Id, WorkerMemory> ends_;  ///< of the edges that a call begins with
  FallenEdges found_;
  FallenCounts counts_;
};

}  // namespace gale::detail
