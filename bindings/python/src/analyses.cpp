#include <algorithm>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/base/error.hpp>
#include <gale/outputs/critical_points.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/manifolds.hpp>
#include <gale/outputs/named_simplices.hpp>
#include <gale/outputs/persistence.hpp>
#include <gale/outputs/persistence_diagram.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/runtime/make_structure.hpp>

#include "fields.hpp"
#include "mesh.hpp"

namespace gale::python {

namespace {

template <class T, class Member>
nb::object column(const std::vector<outputs::DiagramPoint>& diagram, const Member& member) {
  std::vector<T> values;
  values.reserve(diagram.size());
  for (const auto& point : diagram) values.push_back(static_cast<T>(member(point)));
  return numpy_of(std::move(values));
}

/// What `use(structure, order)` finds on the threads of the options, while Python goes on.
template <class Use>
auto analyse(const Mesh& mesh, const io::PointArray& field, RelationSet relations, const SweepOptions& options,
             const Use& use) {
  const Call call;
  const ThreadLimit limit(options.threads);
  const auto structure = make_structure(mesh, relations);
  return use(*structure, order_of(mesh, field));
}

}  // namespace

nb::tuple PyMesh::critical_points(Array1 values, const std::string& name, int threads,
                                  const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const io::PointArray field = field_of(values, name);
  return numpy_of(
      analyse(mesh(), field, critical_points_relations, options, [&](Structure& structure, const VertexOrder& order) {
        return outputs::to_point_set(with(field), find_critical_points(structure, order, options));
      }));
}

nb::tuple PyMesh::critical_simplices(Array1 values, const std::string& name, int threads,
                                     const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const io::PointArray field = field_of(values, name);
  const auto find = [&](Structure& structure, const VertexOrder& order) {
    const DiscreteGradient gradient = find_discrete_gradient(structure, order, options);
    const CriticalSimplices& critical = gradient.critical();
    const SimplexNumbers numbers = number_simplices(structure, {critical.edges, critical.triangles}, options);
    return outputs::to_point_set(with(field), outputs::known_simplices(gradient, critical, numbers));
  };
  return numpy_of(analyse(mesh(), field, discrete_gradient_relations, options, find));
}

nb::dict PyMesh::persistence_diagram(Array1 values, const std::string& name, double persistence, bool is_percent,
                                     int threads, const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const io::PointArray field = field_of(values, name);
  const auto find = [&](Structure& structure, const VertexOrder& order) {
    const DiscreteGradient gradient = find_discrete_gradient(structure, order, options);
    return outputs::persistence_diagram(gradient, find_persistence_pairs(gradient, options), field,
                                        outputs::threshold_of({persistence, is_percent}, field));
  };
  const auto diagram = analyse(mesh(), field, discrete_gradient_relations, options, find);
  using Point = outputs::DiagramPoint;
  nb::dict columns;
  columns["type"] = column<std::int8_t>(diagram, [](const Point& point) { return point.type; });
  columns["birth"] = column<double>(diagram, [](const Point& point) { return point.birth; });
  columns["death"] = column<double>(diagram, [](const Point& point) { return point.death; });
  columns["is_finite"] = column<std::uint8_t>(diagram, [](const Point& point) { return point.is_finite; });
  columns["birth_vertex"] = column<Id>(diagram, [](const Point& point) { return point.begin; });
  columns["death_vertex"] = column<Id>(diagram, [](const Point& point) { return point.end; });
  return columns;
}

nb::dict PyMesh::morse_smale(Array1 values, const std::string& name, std::optional<double> persistence, bool is_percent,
                             bool extrema_only, int threads, const nb::object& progress) const {
  const SweepOptions options = sweep_options(threads, progress);
  const io::PointArray field = field_of(values, name);
  io::PointSet critical_points;
  io::Surface lines;
  std::vector<io::PointArray> manifolds;
  KeptBelow kept;
  analyse(mesh(), field, morse_smale_relations, options, [&](Structure& structure, const VertexOrder& order) {
    const DiscreteGradient gradient = find_discrete_gradient(structure, order, options);
    MorseSmaleComplex complex = find_morse_smale_complex(structure, gradient, {}, options);
    if (persistence) {
      SimplifyOptions how;
      how.extrema_only = extrema_only;
      how.threads = options.threads;
      complex = simplify(
          complex, [&](Id vertex) { return outputs::value_at(field, vertex); },
          outputs::threshold_of({*persistence, is_percent}, field), how);
    }
    const NamedSimplices named = outputs::named_simplices(complex);
    const SimplexNumbers numbers = number_simplices(structure, named, options);
    const auto critical = outputs::known_simplices(complex.gradient, complex.critical, numbers);
    const io::Dataset dataset = with(field);
    critical_points = outputs::to_point_set(dataset, critical);
    critical_points.arrays.push_back(outputs::manifold_sizes(complex));
    lines = outputs::separatrices1(dataset, field, complex, named, numbers, critical);
    manifolds = outputs::manifold_arrays(complex);
    kept = complex.kept_below;
  });
  nb::dict parts;
  parts["critical_points"] = numpy_of(std::move(critical_points));
  parts["separatrices1"] = numpy_of(std::move(lines));
  parts["manifolds"] = numpy_of(std::move(manifolds));
  parts["kept_below"] = kept.count();
  return parts;
}

}  // namespace gale::python
