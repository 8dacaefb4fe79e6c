#include "critical_simplices.hpp"

#include <gale/io/arrays.hpp>

#include "positions.hpp"

namespace gale::app {

namespace {

/// The rows of the output, as far as they don't depend on the type of coordinates.
struct Rows {
  std::vector<Point> positions;
  std::vector<std::int8_t> dimensions, on_boundary;
  std::vector<Id> cells, highest;  ///< input ids
};

/// Takes the critical simplices of all dimensions.
template <class Coordinate>
class Collector {
 public:
  Collector(const io::Dataset::Points<Coordinate>& points, const DiscreteGradient& gradient, const SimplexNumbers& numbers)
      : points_(points), mesh_(gradient.mesh()), keys_(gradient.order().keys()), numbers_(numbers) {}

  Rows collect(const CriticalSimplices& critical) {
    for (const Id v : critical.vertices) add(0, input(v), v, point_of(points_, input(v)));
    for (std::size_t i = 0; i < critical.edges.size(); ++i) {
      const auto& edge = critical.edges[i];
      add(1, numbers_.edges[i], edge[0], barycentre(points_, input(edge)));
    }
    for (std::size_t i = 0; i < critical.triangles.size(); ++i) {
      const auto& triangle = critical.triangles[i];
      add(2, numbers_.triangles[i], triangle[0], incentre(points_, input(triangle)));
    }
    for (const Id t : critical.tetrahedra) {
      const auto& all = mesh_.host().tetrahedra;
      const std::array<Id, 4> tetrahedron = {all(t, 0), all(t, 1), all(t, 2), all(t, 3)};
      const Id highest = *std::max_element(tetrahedron.begin(), tetrahedron.end(), [&](Id a, Id b) { return keys_[a] < keys_[b]; });
      add(3, mesh_.tetrahedron_input()(t), highest, barycentre(points_, input(tetrahedron)));
    }
    return std::move(rows_);
  }

 private:
  Id input(Id vertex) const { return mesh_.vertex_input()(vertex); }

  template <std::size_t N>
  std::array<Id, N> input(std::array<Id, N> simplex) const {
    for (Id& vertex : simplex) vertex = input(vertex);
    return simplex;
  }

  void add(int dimension, Id cell, Id highest, const Point& position) {
    rows_.positions.push_back(position);
    rows_.dimensions.push_back(static_cast<std::int8_t>(dimension));
    rows_.on_boundary.push_back(static_cast<std::int8_t>(numbers_.on_boundary(highest)));
    rows_.cells.push_back(cell);
    rows_.highest.push_back(input(highest));
  }

  const io::Dataset::Points<Coordinate>& points_;
  const Mesh& mesh_;
  const std::uint64_t* keys_;
  const SimplexNumbers& numbers_;
  Rows rows_;
};

template <class Coordinate>
io::Dataset::Points<Coordinate> to_points(const std::vector<Point>& positions) {
  io::Dataset::Points<Coordinate> points("positions", positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) points(i, axis) = static_cast<Coordinate>(positions[i][axis]);
  }
  return points;
}

}  // namespace

io::PointSet to_point_set(const io::Dataset& dataset, const DiscreteGradient& gradient, const SimplexNumbers& numbers) {
  io::PointSet set;
  Rows rows;
  std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        rows = Collector<Coordinate>(points, gradient, numbers).collect(gradient.critical());
        set.points = to_points<Coordinate>(rows.positions);
      },
      dataset.points);
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, rows.highest));
  set.arrays.push_back({"CellDimension", 1, std::move(rows.dimensions)});
  set.arrays.push_back({"CellId", 1, std::move(rows.cells)});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(rows.on_boundary)});
  set.arrays.push_back({"ttkVertexScalarField", 1, std::move(rows.highest)});
  return set;
}

}  // namespace gale::app
