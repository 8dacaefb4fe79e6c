#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

/// Names simplices of a mesh as users know them.
class Namer {
 public:
  Namer(const DiscreteGradient& gradient, const SimplexNumbers& numbers)
      : input_(gradient.mesh().vertices_in_input()), keys_(gradient.order().keys()), numbers_(numbers) {}

  /// `simplex` are its vertices (GALE's ids) from the highest to the lowest; `cell` is its CellId.
  template <std::size_t N>
  CriticalSimplex name(const std::array<Id, N>& simplex, GlobalId cell) const {
    CriticalSimplex named{cell, {}, N - 1, static_cast<std::int8_t>(numbers_.on_surface(simplex[0]))};
    const std::array<Id, N> vertices = detail::to_input(input_, simplex);
    std::copy(vertices.begin(), vertices.end(), named.vertices.begin());
    return named;
  }

  /// The vertices of a cell may come in any order.
  template <std::size_t N>
  CriticalSimplex name_cell(std::array<Id, N> simplex, GlobalId cell) const {
    std::sort(simplex.begin(), simplex.end(), [this](Id a, Id b) { return keys_[a] > keys_[b]; });
    return name(simplex, cell);
  }

 private:
  OtherIds input_;
  const std::uint64_t* keys_;
  const SimplexNumbers& numbers_;
};

template <class Coordinate>
gale::detail::Point middle_of(const io::Dataset::Points<Coordinate>& points, const CriticalSimplex& simplex) {
  const auto& v = simplex.vertices;
  switch (simplex.dimension) {
    case 0:
      return gale::detail::position_of(points, std::array<Id, 1>{v[0]});
    case 1:
      return gale::detail::position_of(points, std::array<Id, 2>{v[0], v[1]});
    case 2:
      return gale::detail::position_of(points, std::array<Id, 3>{v[0], v[1], v[2]});
    default:
      return gale::detail::position_of(points, v);
  }
}

}  // namespace

KnownSimplices known_simplices(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                               const SimplexNumbers& numbers) {
  const Mesh& mesh = gradient.mesh();
  const CellReader cells = mesh.cell_reader();
  const Namer namer(gradient, numbers);
  KnownSimplices known;
  const auto name_all = [&](int dimension, const auto& simplices, const auto& name) {
    known[dimension].resize(simplices.size());
    parallel_for("GALE::critical_simplices", HostExecutionSpace(), simplices.size(),
                 [&](Offset i) { known[dimension][i] = name(simplices[i], i); });
  };
  const OtherIds vertex_input = mesh.vertices_in_input(), cell_input = mesh.cells_in_input();
  name_all(0, critical.vertices,
           [&](Id v, Offset) { return namer.name(std::array<Id, 1>{v}, mesh.vertex_id(vertex_input[v])); });
  name_all(1, critical.edges, [&](const auto& edge, Offset i) { return namer.name(edge, numbers.edges[i]); });
  if (critical.dimension == 2) {
    name_all(2, critical.cells, [&](Id cell, Offset) {
      return namer.name_cell(detail::corners_of<3>(cells, cell), mesh.cell_id(cell_input[cell]));
    });
    return known;
  }
  name_all(2, critical.triangles,
           [&](const auto& triangle, Offset i) { return namer.name(triangle, numbers.triangles[i]); });
  name_all(3, critical.cells, [&](Id cell, Offset) {
    return namer.name_cell(detail::corners_of<4>(cells, cell), mesh.cell_id(cell_input[cell]));
  });
  return known;
}

KnownSimplices own_simplices(const MorseSmaleComplex& complex, const KnownSimplices& all) {
  KnownSimplices own;
  for (int dimension = 0; dimension < 4; ++dimension) {
    if (complex.is_own[dimension].empty()) {
      own[dimension] = all[dimension];
      continue;
    }
    for (std::size_t i = 0; i < all[dimension].size(); ++i) {
      if (complex.owns(dimension, static_cast<Id>(i))) own[dimension].push_back(all[dimension][i]);
    }
  }
  return own;
}

io::PointSet to_point_set(const io::Dataset& dataset, const KnownSimplices& simplices, const Exchange& exchange) {
  io::PointSet set;
  std::vector<CriticalSimplex> all;
  for (const auto& some : simplices) all.insert(all.end(), some.begin(), some.end());
  const auto for_all = [&](const auto& body) {
    parallel_for("GALE::points_of_simplices", HostExecutionSpace(), all.size(), body);
  };
  std::visit(
      [&](const auto& points) {
        const auto positions = allocate<std::decay_t<decltype(points)>>("GALE::critical_simplices", all.size());
        for_all([&](Offset i) { gale::detail::store(middle_of(points, all[i]), positions, i); });
        set.points = positions;
      },
      dataset.points);
  std::vector<std::int8_t> dimensions(all.size()), on_surface(all.size());
  std::vector<Id> highest(all.size());
  std::vector<GlobalId> cells(all.size()), highest_ids(all.size());
  for_all([&](Offset i) {
    const CriticalSimplex& simplex = all[i];
    dimensions[i] = simplex.dimension;
    on_surface[i] = simplex.on_surface;
    cells[i] = simplex.cell;
    highest[i] = simplex.highest();
    highest_ids[i] = exchange.vertex_id(simplex.highest());
  });
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, highest));
  set.arrays.push_back({"CellDimension", 1, std::move(dimensions)});
  set.arrays.push_back({"CellId", 1, detail::ids_as(exchange, std::move(cells))});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(on_surface)});
  set.arrays.push_back({"ttkVertexScalarField", 1, detail::ids_as(exchange, std::move(highest_ids))});
  return set;
}

}  // namespace gale::outputs
