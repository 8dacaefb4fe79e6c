#pragma once

#include <cstdint>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale::detail {

/// Bits of a Morton code that one axis takes: the octree has this many levels.
inline constexpr int morton_levels = 21;

/// The least and the greatest coordinates of some points; infinite the wrong way round if there are none.
struct Box {
  double low[3];
  double high[3];
};

/// The cube that the octree halves: its side is a power of two, so that points on an integer grid meet cell borders
/// exactly.
struct Cube {
  double origin[3];
  double cells_per_unit;  ///< smallest cells along a unit of length
};

/// Throws gale::Error, with its place, if a point has a coordinate that isn't finite.
template <class Coordinate, class Space>
GALE_EXPORT void require_finite(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points);

/// Throws likewise.
template <class Coordinate, class Space>
GALE_EXPORT Box bounding_box(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points);

/// The cube around a box that holds a point at least.
GALE_EXPORT Cube cube_around(const Box& box);

/// The places of points along the space-filling curve through a cube that holds them: x the highest bit.
template <class Coordinate, class Space>
GALE_EXPORT Array<std::uint64_t, MemoryOf<Space>> morton_codes(const Space& space,
                                                               const Points<Coordinate, MemoryOf<Space>>& points,
                                                               const Cube& cube);

/// First positions of the octree's leaves among sorted Morton codes, ascending, the first being 0: cells of at most
/// `capacity` codes whose parent cell has more. A run of equal codes longer than that is cut every `capacity` codes.
template <class Space>
std::vector<Id> octree_leaves(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& sorted_codes,
                              int capacity);

/// Joins consecutive leaves while together they hold at most `capacity` codes, from the first on. Returns where each
/// segment begins, and then `count`, the number of all codes.
std::vector<Id> merge_leaves(const std::vector<Id>& leaves, Id count, int capacity);

}  // namespace gale::detail
