#include <algorithm>
#include <tuple>
#include <utility>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/order/require_mesh.hpp>
#include <gale/base/error.hpp>

namespace gale {

namespace {

/// Connectors and descending walls, of those parts that the complex is to have.
void find_surfaces(const detail::CriticalPlaces& places, int threads, MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  if (!parts.separatrices2 && complex.gradient.store().is_from_kernels()) {
    try {
      complex.connectors = detail::device_connectors(complex.gradient, complex.critical, places);
      return;
    } catch (const OutOfMemory&) {
      // The host takes one wall after the other.
    }
  }
  auto surfaces = detail::descending_surfaces(complex.gradient, complex.critical, places, parts.separatrices2,
                                              parts.saddle_connectors, threads);
  complex.connectors = std::move(surfaces.connectors);
  complex.descending_walls = std::move(surfaces.walls);
}

/// Finds the manifolds that the complex is to have.
void find_manifolds(MorseSmaleComplex& complex) {
  const MorseSmaleParts& parts = complex.parts;
  if (parts.descending_manifolds) complex.descending_manifold = detail::descending_manifolds(complex.gradient);
  if (parts.ascending_manifolds) complex.ascending_manifold = detail::ascending_manifolds(complex.gradient);
  if (parts.descending_manifolds && parts.ascending_manifolds) {
    std::tie(complex.morse_smale_manifold, complex.morse_smale_manifolds) =
        detail::morse_smale_manifolds(complex.gradient.mesh(), complex.ascending_manifold, complex.descending_manifold);
  }
}

/// Calls structure() if it needs one.
template <class GetStructure>
MorseSmaleComplex find_parts(const DiscreteGradient& gradient, const MorseSmaleParts& parts, int threads,
                             const GetStructure& structure) {
  const bool has_walls = gradient.mesh().dimension() == 3;
  if (!has_walls && parts.separatrices2)
    throw Error("a mesh of triangles has no 2-separatrices: those of a mesh of tetrahedra consist of triangles");
  if (has_walls && parts.saddle_connectors) detail::require_whole_mesh("saddle connectors", gradient.mesh());
  if (parts.separatrices2) detail::require_whole_mesh("2-separatrices", gradient.mesh());
  MorseSmaleComplex complex{gradient, parts, gradient.critical()};
  if (gradient.mesh().exchange().ranks().size() > 1) {
    if (parts.descending_separatrices)
      complex.descending = detail::descending_separatrices_on_ranks(gradient, complex.beyond);
    if (parts.ascending_separatrices)
      complex.ascending = detail::ascending_separatrices_on_ranks(gradient, complex.beyond);
    find_manifolds(complex);
    return complex;
  }
  const detail::CriticalPlaces places(gradient.critical());
  if (parts.descending_separatrices)
    complex.descending = detail::descending_separatrices(gradient.mesh(), gradient.store().vertex_successors(),
                                                         complex.critical, places);
  if (parts.ascending_separatrices)
    complex.ascending = detail::ascending_separatrices(gradient.store().cell_successors(), complex.critical, places);
  if (has_walls && (parts.saddle_connectors || parts.separatrices2)) find_surfaces(places, threads, complex);
  if (parts.separatrices2) complex.ascending_walls = detail::ascending_walls(structure(), gradient, threads);
  find_manifolds(complex);
  return complex;
}

}  // namespace

MorseSmaleComplex find_morse_smale_complex(const DiscreteGradient& gradient, const MorseSmaleParts& parts,
                                           const ComputeOptions& options, Computed* computed) {
  detail::Computing computing(gradient.mesh(), options, computed);
  return find_parts(gradient, parts, std::max(options.threads, 1),
                    [&]() -> Structure& { return computing.structure(morse_smale_relations); });
}

MorseSmaleComplex find_morse_smale_complex(Structure& structure, const DiscreteGradient& gradient,
                                           const MorseSmaleParts& parts, const SweepOptions& options) {
  detail::require_same_mesh("the gradient", gradient.mesh(), structure.mesh());
  const ThreadLimit limit(options.threads);
  return find_parts(gradient, parts, std::max(options.threads, 1), [&]() -> Structure& { return structure; });
}

}  // namespace gale
