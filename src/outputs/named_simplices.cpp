#include <gale/base/parallel.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/shared_paths.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using Edge = std::array<Id, 2>;
using Triangle = TriangleVertices;

/// The first N vertices that both have. Takes no branches, which nobody could foretell.
template <std::size_t N, class Simplex>
std::array<Id, N> common(const Simplex& a, const Simplex& b) {
  Simplex both{};
  std::size_t found = 0;
  for (const Id vertex : a) {
    both[found] = vertex;
    found += detail::has(b, vertex);
  }
  std::array<Id, N> first;
  for (std::size_t k = 0; k < N; ++k) first[k] = both[k];
  return first;
}

/// Finds what precedes cells of the paths, by its number: before the first of a path the saddle where it begins, before
/// another what `between` says that it and the one before share, of what `look` says of each.
template <class Cell, class Simplex, class Look, class Between>
void find_between(const Separatrices<Cell>& paths, const SharedPaths& shared, const std::vector<Simplex>& saddles,
                  const Look& look, const Between& between, Simplex* simplices) {
  parallel_for("GALE::between_cells", HostExecutionSpace(), paths.count(), [&](Offset i) {
    const Offset begin = paths.begin[i];
    if (begin == paths.begin[i + 1]) return;
    Offset looked_at = begin;
    auto seen = look(paths.cells[begin]);
    for (Offset k = begin; k < paths.begin[i + 1]; ++k) {
      const Id number = shared.between(k);
      if (shared.first_between(number) != k) continue;
      if (k == begin) {
        simplices[number] = saddles[paths.sources[i]];
        continue;
      }
      const auto before = looked_at == k - 1 ? seen : look(paths.cells[k - 1]);
      seen = look(paths.cells[k]);
      looked_at = k;
      simplices[number] = between(before, seen);
    }
  });
}

}  // namespace

NamedPaths named_simplices(const MorseSmaleComplex& complex) {
  const auto &falling = complex.descending, &rising = complex.ascending;
  const auto& connectors = complex.connectors;
  const Mesh& mesh = complex.excerpt.mesh();
  const CellReader cells = mesh.cell_reader();
  const bool is_excerpt = mesh.is_part();
  NamedPaths named = {
      {complex.critical.edges, complex.critical.triangles, is_excerpt ? std::optional(mesh) : std::nullopt},
      detail::share(falling),
      detail::share(rising),
      detail::share(connectors)};
  const detail::NamedGroups groups(complex, named);
  const bool is_flat = complex.critical.dimension == 2;
  gale::detail::side_by_side(
      [&] {
        if (!is_flat) named.triangles.resize(groups.connector_triangles + named.connectors.first_cell.extent(0));
      },
      [&] { named.edges.resize(groups.ascending_edges + (is_flat ? named.ascending.first_between.extent(0) : 0)); });
  const auto itself = [](const auto& cell) { return cell; };
  const auto edge_of = [](Id a, Id b) { return Edge{a, b}; };
  Edge* const edges = named.edges.data();
  find_between(falling, named.descending, complex.critical.edges, itself, edge_of, edges + groups.descending_edges);
  find_between(connectors, named.connectors, complex.critical.edges, itself, common<2, Triangle>,
               edges + groups.connector_edges);
  if (is_flat) {
    const auto corners = [&](Id cell) { return detail::corners_of<3>(cells, cell); };
    find_between(rising, named.ascending, complex.critical.edges, corners, common<2, Triangle>,
                 edges + groups.ascending_edges);
    return named;
  }
  const auto corners = [&](Id cell) { return detail::corners_of(cells, cell); };
  find_between(rising, named.ascending, complex.critical.triangles, corners, common<3, std::array<Id, 4>>,
               named.triangles.data() + groups.ascending_triangles);
  const auto& first = named.connectors.first_cell;
  parallel_for("GALE::triangles_of_connectors", HostExecutionSpace(), first.extent(0),
               [&](Offset i) { named.triangles[groups.connector_triangles + i] = connectors.cells[first(i)]; });
  return named;
}

}  // namespace gale::outputs
