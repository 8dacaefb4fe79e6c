#include <gale/base/stop.hpp>
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
  const auto add = [&](int dimension, const CriticalSimplex& simplex) {
    gale::detail::stop_if_asked_at(static_cast<Offset>(known[dimension].size()));
    known[dimension].push_back(simplex);
  };
  for (const Id v : critical.vertices)
    add(0, namer.name(std::array<Id, 1>{v}, mesh.vertex_id(mesh.vertices_in_input()[v])));
  for (std::size_t i = 0; i < critical.edges.size(); ++i) add(1, namer.name(critical.edges[i], numbers.edges[i]));
  for (std::size_t i = 0; i < critical.triangles.size(); ++i)
    add(2, namer.name(critical.triangles[i], numbers.triangles[i]));
  for (const Id t : critical.cells) {
    const GlobalId id = mesh.cell_id(mesh.cells_in_input()[t]);
    if (critical.dimension == 2) {
      add(2, namer.name_cell(detail::corners_of<3>(cells, t), id));
    } else {
      add(3, namer.name_cell(detail::corners_of<4>(cells, t), id));
    }
  }
  return known;
}

KnownSimplices own_simplices(const MorseSmaleComplex& complex, const KnownSimplices& all) {
  KnownSimplices own;
  for (int dimension = 0; dimension < 4; ++dimension) {
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
  std::visit(
      [&](const auto& points) {
        std::decay_t<decltype(points)> positions("GALE::critical_simplices", all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
          gale::detail::stop_if_asked_at(static_cast<Offset>(i));
          gale::detail::store(middle_of(points, all[i]), positions, i);
        }
        set.points = positions;
      },
      dataset.points);
  std::vector<std::int8_t> dimensions, on_surface;
  std::vector<Id> highest;
  std::vector<GlobalId> cells, highest_ids;
  for (const CriticalSimplex& simplex : all) {
    gale::detail::stop_if_asked_at(static_cast<Offset>(cells.size()));
    dimensions.push_back(simplex.dimension);
    on_surface.push_back(simplex.on_surface);
    cells.push_back(simplex.cell);
    highest.push_back(simplex.highest());
    highest_ids.push_back(exchange.vertex_id(simplex.highest()));
  }
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, highest));
  set.arrays.push_back({"CellDimension", 1, std::move(dimensions)});
  set.arrays.push_back({"CellId", 1, detail::ids_as(exchange, std::move(cells))});
  set.arrays.push_back({"IsOnBoundary", 1, std::move(on_surface)});
  set.arrays.push_back({"ttkVertexScalarField", 1, detail::ids_as(exchange, std::move(highest_ids))});
  return set;
}

}  // namespace gale::outputs
