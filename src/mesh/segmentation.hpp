#pragma once

#include <cstdint>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// A partition of a mesh' vertices into segments, and with it GALE's own numbering of the vertices: segment after
/// segment, none of them empty. Both arrays lie in the workers' memory.
struct Segmentation {
  Array<Id, WorkerMemory> vertex_input;  ///< GALE's vertex id -> input vertex id; a permutation
  Array<Id, WorkerMemory> vertex_begin;  ///< segment -> its first vertex (GALE's id), and one past the last; ascending

  Id vertices() const { return static_cast<Id>(vertex_input.extent(0)); }
  Id segments() const { return static_cast<Id>(vertex_begin.extent(0)) - 1; }
};

/// Coordinates of points as a caller has them, in host memory or the workers'.
template <class Coordinate, class Memory>
using Points = Kokkos::View<const Coordinate* [3], Kokkos::LayoutRight, Memory>;

/// The leaves of a PR octree that hold at most `capacity` vertices each, consecutive ones merged while they fit.
/// Vertices and thus segments are in Morton order (x the highest bit), those of one cell of the deepest level in input
/// order. More than `capacity` vertices at one point (to 2^-21 of the mesh' extent) are split arbitrarily.
///
/// `Coordinate` is float or double. Takes time O(n), 12 bytes a vertex beside the result.
/// Throws gale::Error for a capacity below 1, more than 2^31 - 1 points, or a coordinate that isn't finite.
template <class Coordinate, class Memory>
Segmentation octree_segmentation(const Points<Coordinate, Memory>& points, int capacity);

/// The segments that the caller gives: vertices with equal labels, in input order; segments in ascending order of
/// label. Labels may have gaps and any sign.
Segmentation given_segmentation(const Array<const std::int64_t, HostMemory>& labels);

}  // namespace gale
