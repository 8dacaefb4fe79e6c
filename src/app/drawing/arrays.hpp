#pragma once

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <gale/app/drawing/scene.hpp>
#include <gale/io/dataset.hpp>

// What pictures are made of, as results have it.

namespace gale::app {

/// Points of either type, as doubles.
inline std::vector<Point> to_points(const io::Dataset::Positions& points) {
  std::vector<Point> all;
  std::visit(
      [&](const auto& rows) {
        all.resize(rows.extent(0));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = {rows(i, 0), rows(i, 1), rows(i, 2)};
      },
      points);
  return all;
}

/// The array of that name, which must be there.
inline const io::PointArray& array_of(const std::vector<io::PointArray>& arrays, const std::string& name) {
  return *std::find_if(arrays.begin(), arrays.end(), [&](const io::PointArray& array) { return array.name == name; });
}

/// The values of the array of that name and type, which must be there.
template <class T>
const std::vector<T>& values_of(const std::vector<io::PointArray>& arrays, const std::string& name) {
  return std::get<std::vector<T>>(array_of(arrays, name).values);
}

}  // namespace gale::app
