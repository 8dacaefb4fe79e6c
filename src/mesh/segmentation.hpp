#pragma once

#include <cstdint>

#include <gale/base/mirrored.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale {

/// A partition of a mesh's vertices into segments, and with it GALE's own numbering of the vertices: segment after
/// segment, none of them empty.
struct Segmentation {
  Mirrored<Id> vertex_input;  ///< GALE's vertex id -> input vertex id; a permutation
  Mirrored<Id> vertex_begin;  ///< segment -> its first vertex (GALE's id), and one past the last; ascending

  /// For the part of a mesh that one rank of several has: the first so many segments hold the vertices that it owns,
  /// the others ghosts. no_id for a whole mesh, which has no ghosts.
  Id owned_segments = no_id;

  /// How many vertices it numbers.
  Id vertices() const { return static_cast<Id>(vertex_input.size()); }

  /// How many segments it has.
  Id segments() const { return static_cast<Id>(vertex_begin.size()) - 1; }

  /// Whether it is that of one rank's part of a mesh.
  bool is_part() const { return owned_segments != no_id; }
};

/// Coordinates of points as a caller has them, in host memory or the workers'.
template <class Coordinate, class Memory>
using Points = Kokkos::View<const Coordinate* [3], Kokkos::LayoutRight, Memory>;

/// Vertices of a segment, at most, unless the caller says otherwise. With more, segments of irregular meshes don't fit
/// the fast memory of a device's teams; on a host it makes no difference.
inline constexpr int default_capacity = 64;

/// Makes segments of the leaves of a PR octree that hold at most `capacity` vertices each, consecutive ones merged
/// while they fit. Vertices and thus segments are in Morton order (x the highest bit), those of one cell of the deepest
/// level in input order. More than `capacity` vertices at one point (to 2^-21 of the mesh's extent) are split
/// arbitrarily.
///
/// `Coordinate` is float or double. Takes time O(n), 24 bytes a vertex beside the result in the workers' memory; the
/// host computes where that doesn't fit.
/// Throws gale::Error for a capacity below 1, more than 2^31 - 1 points, or a coordinate that isn't finite.
template <class Coordinate, class Memory>
GALE_EXPORT Segmentation octree_segmentation(const Points<Coordinate, Memory>& points, int capacity = default_capacity);

/// Takes the segments that the caller gives: vertices with equal labels, in input order; segments in ascending order of
/// label. Labels may have gaps and any sign.
GALE_EXPORT Segmentation given_segmentation(const Array<const std::int64_t, HostMemory>& labels);

}  // namespace gale
