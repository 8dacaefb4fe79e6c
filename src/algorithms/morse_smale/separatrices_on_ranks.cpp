#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <gale/algorithms/excerpt/gradient_excerpt.hpp>
#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

namespace {

/// Where paths from some simplices leave the part.
std::vector<Id> exits_of(const Mirrored<Id>& successors, const std::vector<Id>& starts) {
  const Id* const next = successors.in<HostMemory>().data();
  std::vector<bool> is_passed(successors.size(), false);
  std::vector<Id> exits;
  for (Id at : starts) {
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

/// Names what separatrices in a wider gradient lead through: makes an excerpt of that alone.
class Telling {
 public:
  explicit Telling(const WiderGradient& wider)
      : wider_(wider), place_(wider.vertices(), no_id), cell_place_(wider.cells(), no_id) {}

  /// Makes the excerpt, in whose ids the separatrices of the complex come to be.
  void tell(MorseSmaleComplex& complex) {
    mark(complex);
    place_cells();
    place_vertices();
    complex.excerpt = excerpt_of(told(), complex.critical.dimension);
    complex.critical = complex.excerpt.critical();
    for (Id& vertex : complex.descending.cells) vertex = place_[vertex];
    for (TriangleVertices& triangle : complex.connectors.cells) triangle = places(triangle);
    const Mesh& mesh = complex.excerpt.mesh();
    std::vector<Id> internal(mesh.cells());
    for (Id t = 0; t < mesh.cells(); ++t) internal[mesh.cells_in_input()[t]] = t;
    for (Id& cell : complex.ascending.cells) cell = internal[cell_place_[cell]];
  }

 private:
  /// Marks it; returns false where it was marked before.
  bool mark_vertex(Id vertex) { return std::exchange(place_[vertex], 0) == no_id; }
  bool mark_cell(Id cell) {
    if (std::exchange(cell_place_[cell], 0) != no_id) return false;
    told_cells_.push_back(cell);
    return true;
  }

  /// Marks what is on paths, before anything else is: where one comes to what is marked, so is the rest of it.
  template <class Mark>
  static void mark_paths(const Separatrices<Id>& paths, const Mark& mark) {
    for (Id i = 0; i < paths.count(); ++i) {
      for (const Id* at = paths.first(i); at != paths.last(i) && mark(*at); ++at) {
      }
    }
  }

  template <class Simplices>
  void mark_vertices_of(const Simplices& simplices) {
    for (const auto& simplex : simplices) {
      for (const Id vertex : simplex) mark_vertex(vertex);
    }
  }

  void mark(const MorseSmaleComplex& complex) {
    const CriticalSimplices& critical = wider_.critical();
    mark_paths(complex.descending, [&](Id vertex) { return mark_vertex(vertex); });
    mark_paths(complex.ascending, [&](Id cell) { return mark_cell(cell); });
    mark_vertices_of(complex.connectors.cells);
    for (const Id vertex : critical.vertices) mark_vertex(vertex);
    mark_vertices_of(critical.edges);
    mark_vertices_of(critical.triangles);
    for (const Id cell : critical.cells) mark_cell(cell);
    for (const Id cell : critical.star) mark_cell(cell);
  }

  /// Numbers cells by global id, so that a cell's place is its number in the excerpt, and marks their vertices.
  void place_cells() {
    std::vector<Id>& told = told_cells_;
    const auto count = static_cast<Offset>(told.size());
    const auto ids = allocate<Array<std::uint64_t, HostMemory>>("GALE::told_cells", count);
    parallel_for("GALE::told_cells", HostExecutionSpace(), count,
                 [&](Offset i) { ids(i) = static_cast<std::uint64_t>(wider_.cell_id(told[i])); });
    if (!std::is_sorted(ids.data(), ids.data() + count)) {
      const auto sorted = stable_sort_places(HostExecutionSpace(), "GALE::told_cells", ids);
      const std::vector<Id> before = told;
      parallel_for("GALE::told_cells", HostExecutionSpace(), count, [&](Offset i) { told[i] = before[sorted(i)]; });
    }
    cells_.resize(told.size());
    parallel_for("GALE::told_cells", HostExecutionSpace(), count, [&](Offset i) {
      cells_[i] = {wider_.cell_id(told[i]), wider_.corners(told[i])};
      cell_place_[told[i]] = static_cast<Id>(i);
    });
    for (const ReachedCell& cell : cells_) {
      for (const Id corner : cell.corners) mark_vertex(corner);
    }
  }

  /// Numbers vertices by global id as well, and has cells name them so.
  void place_vertices() {
    std::vector<Id> by_name(wider_.vertices(), no_id);
    for (Id v = 0; v < wider_.vertices(); ++v) {
      if (place_[v] != no_id) by_name[wider_.name(v)] = v;
    }
    for (const Id v : by_name) {
      if (v == no_id) continue;
      place_[v] = static_cast<Id>(vertices_.size());
      vertices_.push_back(v);
    }
    parallel_for("GALE::told_corners", HostExecutionSpace(), cells_.size(),
                 [&](Offset i) { cells_[i].corners = places(cells_[i].corners); });
  }

  template <std::size_t N>
  std::array<Id, N> places(std::array<Id, N> simplex) const {
    for (Id& vertex : simplex) vertex = place_[vertex];
    return simplex;
  }

  template <class T>
  static Dealt<T> listed(std::size_t count) {
    return dealt<T>("GALE::told", {static_cast<std::int64_t>(count)});
  }

  template <class T, class From, class EntryOf>
  static Dealt<T> listed(const std::vector<From>& from, const EntryOf& entry_of) {
    const Dealt<T> list = listed<T>(from.size());
    parallel_for("GALE::told", HostExecutionSpace(), from.size(),
                 [&](Offset i) { list.entries(i) = entry_of(from[i]); });
    return list;
  }

  Reached told() const {
    const CriticalSimplices& critical = wider_.critical();
    Reached told;
    told.vertices = listed<ReachedVertex>(vertices_, [&](Id v) {
      return ReachedVertex{wider_.vertex_id(v), wider_.value(v)};
    });
    told.cells = listed<ReachedCell>(cells_, [](const ReachedCell& cell) { return cell; });
    told.vertex_steps = listed<std::array<Id, 2>>(critical.vertices, [&](Id v) {
      return std::array<Id, 2>{place_[v], no_id};
    });
    told.cell_steps = listed<std::array<Id, 2>>(critical.cells, [&](Id t) {
      return std::array<Id, 2>{cell_place_[t], no_id};
    });
    told.edges = listed<std::array<Id, 3>>(critical.edges, [&](const auto& edge) {
      return std::array<Id, 3>{place_[edge[0]], place_[edge[1]], edge_is_critical};
    });
    told.critical_triangles =
        listed<TriangleVertices>(critical.triangles, [&](const auto& triangle) { return places(triangle); });
    told.cell_forks = listed<std::array<Id, 2>>(0);
    told.critical_stars = listed<std::array<Id, 4>>(critical.star.size());
    for (std::size_t i = 0; i + 1 < critical.star_begin.size(); ++i) {
      std::array<Id, 4> in_star{0, 0, no_id, 0};
      if (critical.dimension == 3) {
        const auto facet = places(critical.triangles[i]);
        std::copy(facet.begin(), facet.end(), in_star.begin());
      } else {
        const auto facet = places(critical.edges[i]);
        std::copy(facet.begin(), facet.end(), in_star.begin());
      }
      for (Id k = critical.star_begin[i]; k < critical.star_begin[i + 1]; ++k) {
        in_star[3] = cell_place_[critical.star[k]];
        told.critical_stars.entries(k) = in_star;
      }
    }
    return told;
  }

  const WiderGradient& wider_;
  std::vector<Id> place_, cell_place_;  ///< of each vertex and cell, no_id if it isn't told
  std::vector<Id> told_cells_, vertices_;
  std::vector<ReachedCell> cells_;
};

}  // namespace

void separatrices_on_ranks(int threads, MorseSmaleComplex& complex) {
  const DiscreteGradient& gradient = complex.gradient;
  const Mesh& mesh = gradient.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  const MorseSmaleParts& parts = complex.parts;
  const CriticalSimplices& own = gradient.critical();
  const bool has_connectors = parts.saddle_connectors && mesh.dimension() == 3;
  PathStarts down, up;
  WayExits exits;
  std::unique_ptr<ConnectorsHere> connectors;
  const auto cells = PathSimplices::make(gradient, PathSimplices::Kind::rising_cells);
  together(ranks, [&] {
    if (parts.descending_separatrices) down = descending_starts(mesh, own);
    if (parts.ascending_separatrices) up = ascending_starts(own);
    exits.vertices = exits_of(gradient.store().vertex_successors(), down.simplices);
    exits.cells = exits_of(gradient.store().cell_successors(), up.simplices);
    if (!has_connectors) return;
    connectors = std::make_unique<ConnectorsHere>(gradient, CriticalPlaces(own), threads);
    exits.edges = connectors->exits();
  });
  Reached reached = reach_beyond(gradient, exits);
  together(ranks, [&] {
    const WiderGradient wider(gradient, *cells, std::move(reached));
    const CriticalPlaces places(wider.critical());
    for (Id& source : down.sources) source = wider.own_edges()[source];
    complex.descending = paths_along(wider.vertex_successors(), down, [&](Id v) { return places.of_vertex(v); });
    complex.ascending = paths_along(wider.cell_successors(), up, [&](Id t) { return places.of_cell(t); });
    if (connectors) complex.connectors = connectors->finish(wider.ground(), places, wider.own_edges());
    Telling(wider).tell(complex);
  });
}

}  // namespace gale::detail
