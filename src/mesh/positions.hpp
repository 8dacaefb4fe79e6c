#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gale/base/ordered.hpp>
#include <gale/base/types.hpp>

// Where simplices are drawn. A simplex is given by its input vertices, in any order: the position is the same, to the
// last bit, in whichever order they come. `points` is a View of the coordinates of each, in host memory.

namespace gale::detail {

using Point = std::array<double, 3>;

template <class View>
Point point_of(const View& points, Id vertex) {
  return {points(vertex, 0), points(vertex, 1), points(vertex, 2)};
}

template <class View, std::size_t N>
Point barycentre(const View& points, const std::array<Id, N>& simplex) {
  Point sum{};
  for (const Id vertex : ascending(simplex)) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += points(vertex, axis);
  }
  for (double& coordinate : sum) coordinate /= N;
  return sum;
}

/// std::hypot(x, y, z), to the last bit; in a grid, where those that aren't 0 are as long as one another, without
/// dividing.
inline double length_of(double x, double y, double z) {
  x = std::abs(x), y = std::abs(y), z = std::abs(z);
  const double longest = std::max({x, y, z});
  const int equal = (x == longest) + (y == longest) + (z == longest), zero = (x == 0) + (y == 0) + (z == 0);
  static const double roots[] = {0, 1, std::sqrt(2.0), std::sqrt(3.0)};
  return equal + zero == 3 ? longest * roots[equal] : std::hypot(x, y, z);
}

/// The centre of the circle that touches a triangle's sides; the first corner where all three are one point.
template <class View>
Point incentre(const View& points, const std::array<Id, 3>& triangle) {
  const std::array<Id, 3> vertices = ascending(triangle);
  Point corners[3], sum{};
  double weights[3], all = 0;
  for (int i = 0; i < 3; ++i) corners[i] = point_of(points, vertices[i]);
  for (int i = 0; i < 3; ++i) {
    const Point &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
    all += weights[i] = length_of(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  if (!(all > 0)) return corners[0];
  for (int i = 0; i < 3; ++i) {
    const double part = weights[i] / all;
    for (int axis = 0; axis < 3; ++axis) sum[axis] += part * corners[i][axis];
  }
  return sum;
}

/// Where a simplex is drawn: triangles at their incentre, others at their barycentre.
template <class View, std::size_t N>
Point position_of(const View& points, const std::array<Id, N>& simplex) {
  if constexpr (N == 3) {
    return incentre(points, simplex);
  } else {
    return barycentre(points, simplex);
  }
}

/// Writes a position to a row of `points`.
template <class View>
void store(const Point& position, const View& points, Offset row) {
  using Coordinate = typename View::non_const_value_type;
  for (int axis = 0; axis < 3; ++axis) points(row, axis) = static_cast<Coordinate>(position[axis]);
}

}  // namespace gale::detail
