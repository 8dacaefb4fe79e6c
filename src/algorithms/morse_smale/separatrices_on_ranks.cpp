#include <memory>
#include <utility>

#include <gale/algorithms/excerpt/passed_simplices.hpp>
#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>

namespace gale::detail {

namespace {

/// Finds where paths leave the part, unless that is known.
std::vector<Id> exits_of(const Mirrored<Id>& successors, const PathExits& paths) {
  if (paths.are_known) return paths.exits;
  const Id* const next = successors.in<HostMemory>().data();
  std::vector<bool> is_passed(successors.size(), false);
  std::vector<Id> exits;
  for (Id at : paths.starts.simplices) {
    while (next[at] >= 0 && !is_passed[at]) {
      is_passed[at] = true;
      at = next[at];
    }
    if (is_passed[at]) continue;
    is_passed[at] = true;
    if (next[at] == DiscreteGradient::elsewhere) exits.push_back(at);
  }
  return exits;
}

}  // namespace

void separatrices_on_ranks(int threads, PathExits down, PathExits up, MorseSmaleComplex& complex) {
  const DiscreteGradient& gradient = complex.gradient;
  const Mesh& mesh = gradient.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  const MorseSmaleParts& parts = complex.parts;
  const CriticalSimplices& own = gradient.critical();
  const bool has_connectors = parts.saddle_connectors && mesh.dimension() == 3;
  WayExits exits;
  std::unique_ptr<ConnectorsHere> connectors;
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  together(ranks, [&] {
    exits.vertices = exits_of(gradient.store().vertex_successors(), down);
    exits.cells = exits_of(gradient.store().cell_successors(), up);
    if (!has_connectors) return;
    connectors = std::make_unique<ConnectorsHere>(gradient, CriticalPlaces(own), threads);
    exits.edges = connectors->exits();
  });
  Reached reached = reach_beyond(gradient, exits);
  together(ranks, [&] {
    const WiderGradient wider(gradient, std::make_shared<const WiderSimplices>(gradient, *cells, reached), reached);
    reached = {};
    const CriticalPlaces places(wider.critical());
    for (Id& source : down.starts.sources) source = wider.own_edges()[source];
    complex.descending = paths_along(wider.vertex_successors(), down.starts, [&](Id v) { return places.of_vertex(v); });
    complex.ascending = paths_along(wider.cell_successors(), up.starts, [&](Id t) { return places.of_cell(t); });
    if (connectors) complex.connectors = connectors->finish(wider, places, wider.own_edges());
    complex.is_own = wider.is_own();
    name_in_excerpt(wider, complex);
  });
}

}  // namespace gale::detail
