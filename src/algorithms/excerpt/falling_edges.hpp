#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/gradient/edges_in_kernels.hpp>
#include <gale/base/key_table.hpp>
#include <gale/base/launch_chain.hpp>

namespace gale::detail {

/// An edge that falls, the higher end first, and the third vertex of the triangle that it is paired with, or
/// edge_is_critical.
struct FallenEdge {
  Id high, low, third;
};

/// How many edges kernels have found, those that are other ranks' to follow among all, and those that threads have left
/// open, for launches to go on from in this order.
struct FallenCounts {
  Offset all = 0, left = 0, open = 0;
  LaunchPart part;
};

/// Where kernels put edges that fall. Copies share it.
struct FallenEdges {
  KeyTable all;  ///< by their ends, the higher one first
  Array<FallenEdge, WorkerMemory> open;
  Array<std::array<Id, 2>, WorkerMemory> left;
  Array<FallenCounts, WorkerMemory> counts;  ///< one
};

/// Edges that fall along a gradient that kernels found: from one that is paired with a triangle to the other edges of
/// that triangle, and so on. Each is passed once. A thread goes some steps down one way after the other, and leaves the
/// rest to the next launch. Takes 15 to 40 bytes an edge in the workers' memory, and where there is room up to 700 for
/// each of those that it begins with, or 4 MB for few of them; 110 MB to begin with where many are expected. Refers to
/// the gradient.
class FallingEdges {
 public:
  /// Begins with room for about as many edges as all walls pass, if these are to be expected. Throws OutOfMemory.
  FallingEdges(const DiscreteGradient& gradient, bool expects_all);

  /// Lets some edges fall, the higher ends first, and all that they come to. Returns those of these that are other
  /// ranks' to follow, once each in all calls. Throws OutOfMemory, and is of no use then.
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
