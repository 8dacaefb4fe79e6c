#include <utility>

#include <gale/algorithms/simplify.hpp>
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

ShownComplex::ShownComplex(MorseSmaleComplex& found, const MorseSmaleParts& wanted, const io::Dataset& dataset,
                           const io::PointArray& field, const ComputeOptions& options, Computed& computed,
                           double& seconds)
    : complex(found) {
  connectors_.sources = found.connectors.sources;
  connectors_.destinations = found.connectors.destinations;
  std::optional<gale::detail::Stopwatch> watch(std::in_place, seconds);
  if (!wanted.descending_separatrices) found.descending = {};
  if (!wanted.ascending_separatrices) found.ascending = {};
  if (!wanted.saddle_connectors) found.connectors = {};
  const Mesh &mesh = found.gradient.mesh(), &excerpt = mesh_of_excerpt(found);
  at_.emplace(excerpt, mesh, dataset, field);
  const NamedPaths named = named_simplices(found);
  watch.reset();
  numbers = number_simplices(mesh, named, options, &computed);
  watch.emplace(seconds);
  critical_ = known_simplices(found.excerpt, found.critical, numbers);
  critical_points = to_point_set(at_->dataset(), own_simplices(found, critical_), excerpt.exchange());
  critical_points.arrays.push_back(manifold_sizes(found));
  separatrices1 = outputs::separatrices1(at_->dataset(), at_->field(), found, named, numbers, critical_);
}

io::Surface ShownComplex::separatrices2() const {
  return outputs::separatrices2(at_->dataset(), at_->field(), complex, connectors_, critical_);
}

MorseSmaleOutputs morse_smale(const DiscreteGradient& gradient, const io::Dataset& dataset, const io::PointArray& field,
                              const MorseSmaleRequest& request, const ComputeOptions& options, Computed* computed) {
  Computed own;
  if (computed == nullptr) computed = &own;
  MorseSmaleComplex complex = find_complex(gradient, field, request, options, computed);
  double seconds = 0;
  ShownComplex shown(complex, request.parts, dataset, field, options, *computed, seconds);
  MorseSmaleOutputs all{std::move(shown.critical_points), std::move(shown.separatrices1), {}, {}, {}};
  if (request.parts.separatrices2) all.separatrices2 = shown.separatrices2();
  all.manifolds = manifold_arrays(complex);
  all.kept_below = complex.kept_below;
  return all;
}

}  // namespace gale::outputs
