#include <algorithm>
#include <memory>

#include <gale/distributed/distributed_gradient.hpp>
#include <gale/distributed/together.hpp>

namespace gale {

namespace {

template <class Find>
DistributedGradient find_by(const DistributedMesh& mesh, const Find& find) {
  std::unique_ptr<const DiscreteGradient> local;
  detail::together(mesh.ranks(), [&] { local = std::make_unique<const DiscreteGradient>(find()); });
  DistributedGradient gradient{mesh, *local};
  const auto counts = local->critical().counts();
  std::copy(counts.begin(), counts.end(), gradient.counts.begin());
  mesh.ranks().sum(gradient.counts.data(), static_cast<int>(gradient.counts.size()));
  return gradient;
}

}  // namespace

DistributedCriticalSimplices DistributedGradient::critical() const {
  const CriticalSimplices& here = local.critical();
  const Id* const input = mesh.local().vertex_input().data();
  const auto id = [&](Id vertex) { return mesh.vertex_id(input[vertex]); };
  DistributedCriticalSimplices critical;
  for (const Id vertex : here.vertices) critical.vertices.push_back(id(vertex));
  for (const auto& [high, low] : here.edges) critical.edges.push_back({id(high), id(low)});
  for (const auto& [high, middle, low] : here.triangles) critical.triangles.push_back({id(high), id(middle), id(low)});
  for (const Id t : here.tetrahedra)
    critical.tetrahedra.push_back(mesh.tetrahedron_id(mesh.local().tetrahedron_input()(t)));
  return critical;
}

DistributedGradient find_discrete_gradient(Structure& structure, const DistributedOrder& order,
                                           const SweepOptions& options) {
  return find_by(order.mesh(), [&] { return find_discrete_gradient(structure, order.local(), options); });
}

DistributedGradient find_discrete_gradient(const WorkerSpace& space, const DistributedOrder& order,
                                           const DeviceSweepOptions& options) {
  return find_by(order.mesh(), [&] { return find_discrete_gradient(space, order.local(), options); });
}

}  // namespace gale
