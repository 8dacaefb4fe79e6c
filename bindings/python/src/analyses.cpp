#include <utility>

#include <gale/algorithms/critical_points.hpp>
#include <gale/outputs/arrows.hpp>
#include <gale/outputs/critical_points.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/persistence_diagram.hpp>

#include "fields.hpp"
#include "job.hpp"
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

/// What `use(order, field)` finds on the threads of the options, while Python goes on.
template <class Use>
auto analyse(Job& job, const Mesh& mesh, const Array1& values, const std::string& name, const ComputeOptions& options,
             const Use& use) {
  return job.run([&] {
    const ThreadLimit limit(options.threads);
    const io::PointArray field = field_of(values, name);
    return use(order_of(mesh, field), field);
  });
}

io::PointSet critical_set(const DiscreteGradient& gradient, const io::Dataset& dataset, const ComputeOptions& options,
                          Computed& computed) {
  const CriticalSimplices& critical = gradient.critical();
  const SimplexNumbers numbers =
      number_simplices(gradient.mesh(), {critical.edges, critical.triangles}, options, &computed);
  return outputs::to_point_set(dataset, outputs::known_simplices(gradient, critical, numbers));
}

}  // namespace

nb::tuple PyMesh::critical_points(Array1 values, const std::string& name, int threads,
                                  const nb::object& progress) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  return numpy_of(
      analyse(job, mesh(), values, name, options, [&](const VertexOrder& order, const io::PointArray& field) {
        return outputs::to_point_set(with(field), find_critical_points(order, options));
      }));
}

nb::tuple PyMesh::critical_simplices(Array1 values, const std::string& name, int threads,
                                     const nb::object& progress) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  const auto find = [&](const VertexOrder& order, const io::PointArray& field) {
    Computed computed;
    const DiscreteGradient gradient = find_discrete_gradient(order, options, &computed);
    return critical_set(gradient, with(field), options, computed);
  };
  return numpy_of(analyse(job, mesh(), values, name, options, find));
}

nb::tuple PyMesh::discrete_gradient(Array1 values, const std::string& name, int threads,
                                    const nb::object& progress) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  const auto find = [&](const VertexOrder& order, const io::PointArray& field) {
    Computed computed;
    const DiscreteGradient gradient = find_discrete_gradient(order, options, &computed);
    const io::Dataset dataset = with(field);
    return std::make_pair(critical_set(gradient, dataset, options, computed), outputs::arrows_of(dataset, gradient));
  };
  auto [critical, arrows] = analyse(job, mesh(), values, name, options, find);
  return nb::make_tuple(numpy_of(std::move(critical)), numpy_of(std::move(arrows)));
}

nb::dict PyMesh::persistence_diagram(Array1 values, const std::string& name, double persistence, bool is_percent,
                                     int threads, const nb::object& progress) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  const auto find = [&](const VertexOrder& order, const io::PointArray& field) {
    const DiscreteGradient gradient = find_discrete_gradient(order, options);
    return outputs::persistence_diagram(gradient, find_persistence_pairs(gradient, options), field,
                                        outputs::threshold_of({persistence, is_percent}, field));
  };
  const auto diagram = analyse(job, mesh(), values, name, options, find);
  using Point = outputs::DiagramPoint;
  nb::dict columns;
  columns["type"] = column<std::int8_t>(diagram, [](const Point& point) { return point.type; });
  columns["birth"] = column<double>(diagram, [](const Point& point) { return point.birth; });
  columns["death"] = column<double>(diagram, [](const Point& point) { return point.death; });
  std::vector<std::uint8_t> is_finite;
  for (const Point& point : diagram) is_finite.push_back(point.is_finite ? 1 : 0);
  columns["is_finite"] = flags_of(std::move(is_finite));
  columns["birth_vertex"] = column<Id>(diagram, [](const Point& point) { return point.begin; });
  columns["death_vertex"] = column<Id>(diagram, [](const Point& point) { return point.end; });
  return columns;
}

nb::dict PyMesh::morse_smale(Array1 values, const std::string& name, std::optional<double> persistence, bool is_percent,
                             bool extrema_only, bool separatrices2, int threads, const nb::object& progress) const {
  Job job(progress);
  const ComputeOptions options = job.sweep_options(threads);
  outputs::MorseSmaleRequest request;
  request.parts.separatrices2 = separatrices2;
  if (persistence) request.persistence = outputs::Persistence{*persistence, is_percent};
  request.extrema_only = extrema_only;
  const auto find = [&](const VertexOrder& order, const io::PointArray& field) {
    Computed computed;
    const DiscreteGradient gradient = find_discrete_gradient(order, options, &computed);
    return outputs::morse_smale(gradient, with(field), field, request, options, &computed);
  };
  auto found = analyse(job, mesh(), values, name, options, find);
  nb::dict parts;
  parts["critical_points"] = numpy_of(std::move(found.critical_points));
  parts["separatrices1"] = numpy_of(std::move(found.separatrices1));
  if (separatrices2) parts["separatrices2"] = numpy_of(std::move(found.separatrices2));
  parts["manifolds"] = numpy_of(std::move(found.manifolds));
  parts["kept_below"] = found.kept_below.count();
  return parts;
}

}  // namespace gale::python
