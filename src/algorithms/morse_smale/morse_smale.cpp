#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <gale/algorithms/excerpt/gradient_excerpt.hpp>
#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/error.hpp>
#include <gale/runtime/ways.hpp>

namespace gale {

namespace {

/// Connectors and descending walls, of those parts that the complex is to have.
void find_surfaces(const detail::CriticalPlaces& places, int threads, MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  if (!parts.separatrices2 && complex.excerpt.store().is_from_kernels()) {
    try {
      auto found = detail::device_connectors(detail::wall_rows(complex.excerpt), complex.critical);
      found.bring();
      complex.connectors = std::move(found.paths);
      return;
    } catch (const OutOfMemory&) {
      // The host takes one wall after the other.
    }
  }
  auto surfaces = detail::descending_surfaces(complex.excerpt, complex.critical, places, parts.separatrices2,
                                              parts.saddle_connectors, threads);
  complex.connectors = std::move(surfaces.connectors);
  complex.descending_walls = std::move(surfaces.walls);
}

/// Leaves those that begin at a saddle that isn't this rank's out.
Separatrices<Id> from_own(Separatrices<Id> all, const std::vector<char>& is_own) {
  if (is_own.empty()) return all;
  Separatrices<Id> own;
  for (Id i = 0; i < all.count(); ++i) {
    if (is_own[all.sources[i]] == 0) continue;
    own.sources.push_back(all.sources[i]);
    own.destinations.push_back(all.destinations[i]);
    own.cells.insert(own.cells.end(), all.first(i), all.last(i));
    own.begin.push_back(static_cast<Offset>(own.cells.size()));
  }
  return own;
}

/// Finds the separatrices that the complex is to have, in its excerpt. Calls structure() if it needs one.
template <class GetStructure>
void find_separatrices(int threads, const GetStructure& structure, MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  const DiscreteGradient& gradient = complex.excerpt;
  const detail::CriticalPlaces places(complex.critical);
  if (parts.descending_separatrices)
    complex.descending = from_own(detail::descending_separatrices(gradient.mesh(), gradient.store().vertex_successors(),
                                                                  complex.critical, places),
                                  complex.is_own[1]);
  if (parts.ascending_separatrices)
    complex.ascending = detail::ascending_separatrices(gradient.store().cell_successors(), complex.critical, places);
  if (gradient.mesh().dimension() == 3 && (parts.saddle_connectors || parts.separatrices2))
    find_surfaces(places, threads, complex);
  if (!parts.separatrices2) return;
  std::vector<Id> sources;
  for (std::size_t i = 0; i < complex.critical.edges.size(); ++i) {
    if (complex.owns(1, static_cast<Id>(i))) sources.push_back(static_cast<Id>(i));
  }
  complex.ascending_walls = detail::ascending_walls(structure(), gradient, sources, threads);
}

/// Which of an excerpt's critical simplices are this rank's: the highest vertices are.
std::array<std::vector<char>, 4> own_simplices(const DiscreteGradient& excerpt, const Mesh& mesh) {
  const CriticalSimplices& critical = excerpt.critical();
  std::array<std::vector<char>, 4> own;
  const auto add = [&](int dimension, Id vertex) {
    const Id here = mesh.vertex_of(excerpt.mesh().vertex_id(excerpt.mesh().vertex_input()(vertex)));
    own[dimension].push_back(here != no_id && mesh.owned_vertices().has(mesh.vertices_of_input()[here]));
  };
  for (const Id vertex : critical.vertices) add(0, vertex);
  for (const auto& edge : critical.edges) add(1, edge[0]);
  for (const auto& triangle : critical.triangles) add(2, triangle[0]);
  for (const Id cell : critical.cells) add(critical.dimension, detail::highest_corner(excerpt, cell));
  return own;
}

/// Finds the manifolds that the complex is to have, and the exits of paths on several ranks, on the way there if it
/// leads past them.
void find_manifolds(MorseSmaleComplex& complex, detail::PathExits* down = nullptr, detail::PathExits* up = nullptr) {
  const MorseSmaleParts& parts = complex.parts;
  if (!parts.descending_manifolds && parts.descending_separatrices && down != nullptr)
    detail::find_exits(complex.gradient, detail::PathSimplices::Kind::falling_vertices, *down);
  if (!parts.ascending_manifolds && parts.ascending_separatrices && up != nullptr)
    detail::find_exits(complex.gradient, detail::PathSimplices::Kind::rising_cells, *up);
  if (parts.descending_manifolds) complex.descending_manifold = detail::descending_manifolds(complex.gradient, down);
  if (parts.ascending_manifolds) complex.ascending_manifold = detail::ascending_manifolds(complex.gradient, up);
  if (parts.descending_manifolds && parts.ascending_manifolds) {
    std::tie(complex.morse_smale_manifold, complex.morse_smale_manifolds) =
        detail::morse_smale_manifolds(complex.gradient.mesh(), complex.ascending_manifold, complex.descending_manifold);
  }
}

/// Finds all parts on several ranks: the separatrices of this rank's saddles. With walls each rank is sent all that
/// these pass. Collective.
template <class GetStructure>
void find_on_ranks(int threads, const GetStructure& structure, MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  const Mesh& mesh = complex.gradient.mesh();
  if (!parts.separatrices2) {
    detail::PathExits down, up;
    detail::together(mesh.exchange().ranks(), [&] {
      const CriticalSimplices& own = complex.gradient.critical();
      if (parts.descending_separatrices) down.starts = detail::descending_starts(mesh, own);
      if (parts.ascending_separatrices) up.starts = detail::ascending_starts(own);
    });
    find_manifolds(complex, &down, &up);
    detail::separatrices_on_ranks(threads, std::move(down), std::move(up), complex);
    return;
  }
  find_manifolds(complex);
  detail::WantedWays ways;
  ways.falling_paths = parts.descending_separatrices;
  ways.rising_paths = parts.ascending_separatrices;
  ways.falling_walls = ways.rising_walls = true;
  Structure* rows = nullptr;
  detail::together(mesh.exchange().ranks(), [&] { rows = &structure(); });
  complex.excerpt = detail::excerpt_of(complex.gradient, ways, rows);
  detail::together(mesh.exchange().ranks(), [&] {
    complex.critical = complex.excerpt.critical();
    complex.is_own = own_simplices(complex.excerpt, mesh);
    detail::InlineStructure around(complex.excerpt.mesh(), morse_smale_relations);
    find_separatrices(
        threads, [&]() -> Structure& { return around; }, complex);
  });
}

/// Calls structure() if it needs one.
template <class GetStructure>
MorseSmaleComplex find_parts(const DiscreteGradient& gradient, const MorseSmaleParts& parts, int threads,
                             const GetStructure& structure) {
  const bool has_walls = gradient.mesh().dimension() == 3;
  if (!has_walls && parts.separatrices2)
    throw SharedError("a mesh of triangles has no 2-separatrices: those of a mesh of tetrahedra consist of triangles");
  MorseSmaleComplex complex{gradient, parts, gradient.critical()};
  if (gradient.mesh().exchange().ranks().size() > 1) {
    find_on_ranks(threads, structure, complex);
  } else {
    find_separatrices(threads, structure, complex);
    find_manifolds(complex);
  }
  return complex;
}

}  // namespace

struct Excerpt::Made {
  detail::Once once;
  std::function<DiscreteGradient()> make;
  std::optional<DiscreteGradient> gradient;
};

Excerpt::Excerpt(const DiscreteGradient& gradient) : made_(std::make_shared<Made>()) { made_->gradient = gradient; }

Excerpt::Excerpt(std::function<DiscreteGradient()> make) : made_(std::make_shared<Made>()) {
  made_->make = std::move(make);
}

const DiscreteGradient& Excerpt::gradient() const {
  made_->once([this] {
    if (made_->make) made_->gradient = made_->make();
    made_->make = nullptr;
  });
  return *made_->gradient;
}

std::array<Id, 4> MorseSmaleComplex::own_counts() const {
  std::array<Id, 4> counts = critical.counts();
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::vector<char>& own = is_own[dimension];
    if (!own.empty()) counts[dimension] = static_cast<Id>(std::count(own.begin(), own.end(), 1));
  }
  return counts;
}

MorseSmaleComplex find_morse_smale_complex(const DiscreteGradient& gradient, const MorseSmaleParts& parts,
                                           const ComputeOptions& options, Computed* computed) {
  detail::Computing computing(gradient.mesh(), options, computed);
  return find_parts(gradient, parts, options.threads,
                    [&]() -> Structure& { return computing.structure(morse_smale_relations); });
}

MorseSmaleComplex find_morse_smale_complex(Structure& structure, const DiscreteGradient& gradient,
                                           const MorseSmaleParts& parts, const SweepOptions& options) {
  detail::require_same_mesh("the gradient", gradient.mesh(), structure.mesh());
  detail::together(gradient.mesh().exchange().ranks(), [&] { detail::require_thread_count(options.threads); });
  const ThreadLimit limit(options.threads);
  return find_parts(gradient, parts, options.threads, [&]() -> Structure& { return structure; });
}

}  // namespace gale
