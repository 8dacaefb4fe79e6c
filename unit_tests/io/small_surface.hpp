#pragma once

#include <vector>

#include <gale/io/write.hpp>

namespace gale::io::test {

inline Dataset::Positions five_points() {
  const Dataset::Points<double> points("GALE::points", 5);
  for (int i = 0; i < 5; ++i) points(i, 1) = 0.1 * i;
  return points;
}

/// The lines 0-1-2 and 2-3, and the triangle 0, 1, 4.
inline Surface two_lines_and_a_triangle() {
  Surface surface;
  surface.points = five_points();
  surface.point_arrays = {{"CellDimension", 1, std::vector<std::int8_t>{0, 1, 0, 3, 2}}};
  surface.lines = {{0, 3, 5}, {0, 1, 2, 2, 3}};
  surface.polygons = {{0, 3}, {0, 1, 4}};
  surface.cell_arrays = {{"SourceId", 1, std::vector<std::int32_t>{7, 8, 9}}};
  return surface;
}

}  // namespace gale::io::test
