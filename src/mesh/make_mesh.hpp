#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/mesh/caller_views.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

/// Makes the mesh of what a caller has in Views of its own: `points` are n x 3 coordinates, `tetrahedra` m x 4 vertex
/// ids. Any layout, in host memory or the workers', managed or not; float or double, any integer type. They are read
/// where they are if their rows are contiguous and their types are those of GALE (std::int32_t or std::int64_t), else
/// copied first. Nothing keeps them.
///
/// Segmented by an octree of `capacity` vertices a segment. Throws as octree_segmentation and Mesh do, and if the
/// second extents aren't 3 and 4.
template <class PointView, class TetrahedronView>
Mesh make_mesh(const PointView& points, const TetrahedronView& tetrahedra, int capacity = default_capacity) {
  return Mesh(detail::rows_of<4, detail::IndexFor>("tetrahedra", tetrahedra),
              octree_segmentation(detail::rows_of<3, detail::CoordinateFor>("points", points), capacity));
}

/// Makes the mesh of vectors of 3 coordinates a point and 4 vertex ids a tetrahedron. Throws gale::Error, too, if the
/// lengths are no multiples of 3 and 4.
template <class Coordinate, class Index>
Mesh make_mesh(const std::vector<Coordinate>& points, const std::vector<Index>& tetrahedra,
               int capacity = default_capacity) {
  return make_mesh(detail::view_of<3>("points", points), detail::view_of<4>("tetrahedra", tetrahedra), capacity);
}

}  // namespace gale
