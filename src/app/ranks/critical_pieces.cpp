#include <numeric>

#include <gale/app/ranks/complex_pieces.hpp>
#include <gale/distributed/key_places.hpp>
#include <gale/distributed/sums_by_id.hpp>

namespace gale::app {

namespace {

std::vector<Id> counted(std::size_t count) {
  std::vector<Id> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Id(0));
  return numbers;
}

/// Gives an array of a set other values.
void replace(io::PointSet& set, const std::string& name, std::vector<std::int64_t> values) {
  for (io::PointArray& array : set.arrays) {
    if (array.name == name) array.values = std::move(values);
  }
}

using GlobalIds = Array<GlobalId, HostMemory>;

/// How many vertices of all ranks have each of these labels.
GlobalIds sizes_of(const DistributedMesh& mesh, const Array<const GlobalId, HostMemory>& labels,
                   const Array<const GlobalId, HostMemory>& asked) {
  const Id* const input = mesh.local().vertex_input().data();
  std::vector<GlobalId> owned;
  detail::together(mesh.ranks(), [&] {
    for (Id v = 0; v < mesh.local().owned_vertices(); ++v) {
      if (labels(input[v]) >= 0) owned.push_back(labels(input[v]));
    }
  });
  return detail::occurrences(mesh.ranks(), Array<const GlobalId, HostMemory>(owned.data(), owned.size()), asked);
}

GlobalIds places_of_minima(const DistributedGradient& gradient, const DistributedManifolds& manifolds) {
  const auto& minima = gradient.local.critical().vertices;
  const GlobalIds places("GALE::places_of_minima", minima.size());
  const auto& input = gradient.mesh.local().vertex_input();
  for (std::size_t i = 0; i < minima.size(); ++i) places(i) = manifolds.descending(input(minima[i]));
  return places;
}

GlobalIds places_of_maxima(const DistributedGradient& gradient) {
  const auto& maxima = gradient.local.critical().tetrahedra;
  const Array<detail::SimplexKey, HostMemory> keys("GALE::maxima", maxima.size());
  const auto& input = gradient.mesh.local().tetrahedron_input();
  for (std::size_t i = 0; i < maxima.size(); ++i) keys(i) = {gradient.mesh.tetrahedron_id(input(maxima[i])), 0, 0};
  return detail::places_of_keys(gradient.mesh.ranks(), keys).places;
}

}  // namespace

DistributedNamedSimplices named_simplices(const DistributedGradient& gradient) {
  DistributedCriticalSimplices critical = gradient.critical();
  return {std::move(critical.edges), std::move(critical.triangles)};
}

void append(const DistributedSeparatrices& descending, const DistributedSeparatrices& ascending,
            DistributedNamedSimplices& named) {
  for (const auto& edge : descending.between) named.edges.push_back({edge[0], edge[1]});
  named.triangles.insert(named.triangles.end(), ascending.between.begin(), ascending.between.end());
}

outputs::KnownSimplices known_simplices(const DistributedGradient& gradient, const DistributedNumbers& numbers) {
  const CriticalSimplices& critical = gradient.local.critical();
  return outputs::known_simplices(
      gradient.local, critical,
      {counted(critical.edges.size()), counted(critical.triangles.size()), numbers.on_surface});
}

io::PointSet to_point_set(const FieldOnRanks& on, const DistributedGradient& gradient,
                          const DistributedNumbers& numbers) {
  const outputs::KnownSimplices known = known_simplices(gradient, numbers);
  io::PointSet set = outputs::to_point_set(on.local, known);
  const DistributedCriticalSimplices critical = gradient.critical();
  std::vector<std::int64_t> cells(critical.vertices.begin(), critical.vertices.end()), highest;
  cells.insert(cells.end(), numbers.edges.begin(), numbers.edges.begin() + critical.edges.size());
  cells.insert(cells.end(), numbers.triangles.begin(), numbers.triangles.begin() + critical.triangles.size());
  cells.insert(cells.end(), critical.tetrahedra.begin(), critical.tetrahedra.end());
  for (const auto& some : known) {
    for (const auto& simplex : some) highest.push_back(on.mesh.vertex_id(simplex.highest()));
  }
  replace(set, "CellId", std::move(cells));
  replace(set, "ttkVertexScalarField", std::move(highest));
  return set;
}

io::PointArray manifold_sizes(const DistributedGradient& gradient, const DistributedManifolds& manifolds,
                              const MorseSmaleParts& wanted) {
  const auto counts = gradient.local.critical().counts();
  GlobalIds of_minima, of_maxima;
  if (wanted.descending_manifolds)
    of_minima = sizes_of(gradient.mesh, manifolds.descending, places_of_minima(gradient, manifolds));
  if (wanted.ascending_manifolds) of_maxima = sizes_of(gradient.mesh, manifolds.ascending, places_of_maxima(gradient));
  std::vector<std::int64_t> sizes;
  for (Id i = 0; i < counts[0]; ++i) sizes.push_back(wanted.descending_manifolds ? of_minima(i) : -1);
  sizes.resize(sizes.size() + counts[1] + counts[2], 0);
  for (Id i = 0; i < counts[3]; ++i) sizes.push_back(wanted.ascending_manifolds ? of_maxima(i) : -1);
  return {"ManifoldSize", 1, std::move(sizes)};
}

}  // namespace gale::app
