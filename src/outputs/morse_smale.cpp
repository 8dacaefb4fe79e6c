#include <gale/algorithms/simplify.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/manifolds.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/outputs/separatrices2.hpp>

namespace gale::outputs {

MorseSmaleParts MorseSmaleRequest::needed_parts() const {
  MorseSmaleParts needed = parts;
  if ((persistence && !extrema_only) || parts.separatrices2) needed.saddle_connectors = true;
  return needed;
}

Separatrices<TriangleVertices> ends_of(const Separatrices<TriangleVertices>& connectors) {
  Separatrices<TriangleVertices> ends;
  ends.sources = connectors.sources;
  ends.destinations = connectors.destinations;
  return ends;
}

void leave_out_unwanted(const MorseSmaleParts& wanted, MorseSmaleComplex& complex) {
  if (!wanted.descending_separatrices) complex.descending = {};
  if (!wanted.ascending_separatrices) complex.ascending = {};
  if (!wanted.saddle_connectors) complex.connectors = {};
}

MorseSmaleComplex find_complex(const DiscreteGradient& gradient, const io::PointArray& field,
                               const MorseSmaleRequest& request, const ComputeOptions& options, Computed* computed) {
  Computed own;
  if (computed == nullptr) computed = &own;
  MorseSmaleParts parts = request.needed_parts();
  const Ranks& ranks = gradient.mesh().exchange().ranks();
  if (ranks.size() > 1 && request.persistence) {  // which gathers the others
    parts.descending_separatrices = parts.ascending_separatrices = parts.saddle_connectors = false;
    parts.separatrices2 = parts.separatrices2 && gradient.mesh().dimension() == 2;  // that is refused
  }
  MorseSmaleComplex complex = find_morse_smale_complex(gradient, parts, options, computed);
  if (!request.persistence) return complex;
  complex.parts = request.needed_parts();
  const gale::detail::Stopwatch running(computed->seconds_running);
  SimplifyOptions how;
  how.extrema_only = request.extrema_only;
  how.paths = Paths::joined;
  how.threads = options.threads;
  const auto value = [&](Id vertex) { return value_at(field, vertex); };
  return simplify(complex, value, threshold_of(*request.persistence, field, ranks), how);
}

MorseSmaleOutputs morse_smale(const DiscreteGradient& gradient, const io::Dataset& dataset, const io::PointArray& field,
                              const MorseSmaleRequest& request, const ComputeOptions& options, Computed* computed) {
  Computed own;
  if (computed == nullptr) computed = &own;
  MorseSmaleComplex complex = find_complex(gradient, field, request, options, computed);
  const auto connectors = ends_of(complex.connectors);  // of all, wanted or not: they bound walls
  leave_out_unwanted(request.parts, complex);
  const Mesh& excerpt = mesh_of_excerpt(complex);
  const NamedPaths named = named_simplices(complex);
  const SimplexNumbers numbers = number_simplices(gradient.mesh(), named, options, computed);
  const KnownSimplices critical = known_simplices(complex.excerpt, complex.critical, numbers);
  MorseSmaleOutputs all;
  const AtExcerpt at(excerpt, gradient.mesh(), dataset, field);
  all.critical_points = to_point_set(at.dataset(), own_simplices(complex, critical), excerpt.exchange());
  all.critical_points.arrays.push_back(manifold_sizes(complex));
  all.separatrices1 = separatrices1(at.dataset(), at.field(), complex, named, numbers, critical);
  if (request.parts.separatrices2)
    all.separatrices2 = separatrices2(at.dataset(), at.field(), complex, connectors, critical);
  all.manifolds = manifold_arrays(complex);
  all.kept_below = complex.kept_below;
  return all;
}

}  // namespace gale::outputs
