#include <gale/base/parallel.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/shared_paths.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using Edge = std::array<Id, 2>;
using Triangle = TriangleVertices;

/// The N vertices that are in both.
template <std::size_t N, class Simplex>
std::array<Id, N> common(const Simplex& a, const Simplex& b) {
  std::array<Id, N> both{};
  std::size_t found = 0;
  for (const Id vertex : a) {
    if (found < N && detail::has(b, vertex)) both[found++] = vertex;
  }
  return both;
}

/// Appends what precedes cells of the paths: before the first of a path the saddle where it begins, before another what
/// `between` says that it and the one before share, of what `look` says of each.
template <class Cell, class Simplex, class Look, class Between>
void append_between(const Separatrices<Cell>& paths, const SharedPaths& shared, const std::vector<Simplex>& saddles,
                    const Look& look, const Between& between, std::vector<Simplex>& simplices) {
  const std::size_t first = simplices.size();
  simplices.resize(first + shared.first_between.extent(0));
  parallel_for("GALE::between_cells", HostExecutionSpace(), paths.count(), [&](Offset i) {
    const Offset begin = paths.begin[i];
    if (begin == paths.begin[i + 1]) return;
    Offset looked_at = begin;
    auto seen = look(paths.cells[begin]);
    for (Offset k = begin; k < paths.begin[i + 1]; ++k) {
      const Id number = shared.between(k);
      if (shared.first_between(number) != k) continue;
      if (k == begin) {
        simplices[first + number] = saddles[paths.sources[i]];
        continue;
      }
      const auto before = looked_at == k - 1 ? seen : look(paths.cells[k - 1]);
      seen = look(paths.cells[k]);
      looked_at = k;
      simplices[first + number] = between(before, seen);
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
  named.edges.reserve(groups.ascending_edges + named.ascending.first_between.extent(0));
  const auto& first = named.connectors.first_cell;
  named.triangles.reserve(groups.connector_triangles + first.extent(0));
  const auto itself = [](const auto& cell) { return cell; };
  const auto edge_of = [](Id a, Id b) { return Edge{a, b}; };
  append_between(falling, named.descending, complex.critical.edges, itself, edge_of, named.edges);
  append_between(connectors, named.connectors, complex.critical.edges, itself, common<2, Triangle>, named.edges);
  if (complex.critical.dimension == 2) {
    const auto corners = [&](Id cell) { return detail::corners_of<3>(cells, cell); };
    append_between(rising, named.ascending, complex.critical.edges, corners, common<2, Triangle>, named.edges);
    return named;
  }
  const auto corners = [&](Id cell) { return detail::corners_of(cells, cell); };
  append_between(rising, named.ascending, complex.critical.triangles, corners, common<3, std::array<Id, 4>>,
                 named.triangles);
  named.triangles.resize(groups.connector_triangles + first.extent(0));
  parallel_for("GALE::triangles_of_connectors", HostExecutionSpace(), first.extent(0),
               [&](Offset i) { named.triangles[groups.connector_triangles + i] = connectors.cells[first(i)]; });
  return named;
}

}  // namespace gale::outputs
