#include <functional>
#include <memory>
#include <utility>

#include <gale/algorithms/excerpt/passed_simplices.hpp>
#include <gale/algorithms/excerpt/ways_beyond.hpp>
#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>

namespace gale::detail {

void separatrices_on_ranks(int threads, PathExits down, PathExits up, MorseSmaleComplex& complex) {
  const DiscreteGradient& gradient = complex.gradient;
  const Mesh& mesh = gradient.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  const MorseSmaleParts& parts = complex.parts;
  const bool has_connectors = parts.saddle_connectors && mesh.dimension() == 3;
  WayExits exits;
  std::unique_ptr<ConnectorsHere> connectors;
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  together(ranks, [&] {
    exits.vertices = std::move(down.links);
    exits.cells = std::move(up.links);
    if (!has_connectors) return;
    connectors = std::make_unique<ConnectorsHere>(gradient, threads);
    exits.edges = connectors->exits();
  });
  Reached reached = reach_beyond(gradient, *cells, exits);
  together(ranks, [&] {
    const WiderGradient wider(gradient, std::make_shared<const WiderSimplices>(gradient, *cells, reached), reached);
    reached = {};
    const CriticalPlaces places(wider.critical());
    for (Id& source : down.starts.sources) source = wider.own_edges()[source];
    complex.descending = paths_along(wider.vertex_successors(), down.starts, [&](Id v) { return places.of_vertex(v); });
    complex.ascending = paths_along(wider.cell_successors(), up.starts, [&](Id t) { return places.of_cell(t); });
    complex.is_own = wider.is_own();
    std::function<FoundConnectors()> find_connectors;
    if (connectors) find_connectors = [&] { return connectors->finish(wider, places, wider.own_edges()); };
    name_in_excerpt(wider, find_connectors, complex);
  });
}

}  // namespace gale::detail
