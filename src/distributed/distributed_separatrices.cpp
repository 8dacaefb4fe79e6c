#include <algorithm>

#include <gale/algorithms/order/written.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/distributed_separatrices.hpp>
#include <gale/distributed/gradient_paths.hpp>
#include <gale/distributed/key_places.hpp>
#include <gale/distributed/path_pieces.hpp>
#include <gale/distributed/places_of_ends.hpp>

namespace gale {

namespace {

/// Where paths start, and from which of this rank's critical edges or triangles.
struct Starts {
  std::vector<Id> simplices;  ///< GALE's ids
  std::vector<Id> sources;    ///< places among the critical ones of this rank
};

/// The places of critical edges, or triangles, among those of all ranks.
template <class Simplex>
detail::KeyPlaces places_of(const DistributedMesh& mesh, const std::vector<Simplex>& simplices) {
  Array<detail::SimplexKey, HostMemory> keys;
  detail::together(mesh.ranks(), [&] {
    keys = allocate<decltype(keys)>("GALE::critical_keys", simplices.size());
    const Id* const input = mesh.local().vertex_input().data();
    for (std::size_t i = 0; i < simplices.size(); ++i) {
      const Simplex ascending = detail::written(input, simplices[i]);
      keys(i) = {0, 0, 0};
      for (std::size_t k = 0; k < ascending.size(); ++k) keys(i)[k] = mesh.vertex_ids()(ascending[k]);
    }
  });
  return detail::places_of_keys(mesh.ranks(), keys);
}

template <class Simplex, class PointOf>
DistributedSeparatrices find(const DistributedMesh& mesh, const detail::PathSimplices& simplices,
                             const std::vector<Simplex>& critical, const Starts& starts, const PointOf& point_of) {
  const Communicator& ranks = mesh.ranks();
  const detail::DistributedPaths paths(ranks, simplices);
  const auto destinations = detail::places_of_ends(ranks, paths);
  const detail::KeyPlaces sources = places_of(mesh, critical);
  const detail::WholePaths whole = detail::whole_paths(ranks, paths, starts.simplices, point_of);
  DistributedSeparatrices found;
  detail::together(ranks, [&] {
    for (std::size_t i = 0; i < starts.simplices.size(); ++i) {
      if (whole.begin[i + 1] == whole.begin[i]) continue;
      found.sources.push_back(sources.places(starts.sources[i]));
      found.destinations.push_back(destinations(paths.end(starts.simplices[i])));
      found.begin.push_back(whole.begin[i + 1]);
    }
    for (const auto& [id, point] : whole.cells) {
      found.cells.push_back(id);
      found.points.push_back(point);
    }
  });
  return found;
}

}  // namespace

DistributedSeparatrices find_descending_separatrices(const DistributedGradient& gradient) {
  const auto& edges = gradient.local.critical().edges;
  const Id* const input = gradient.mesh.local().vertex_input().data();
  Starts starts;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    const bool in_order = input[a] < input[b];
    starts.simplices.insert(starts.simplices.end(), {in_order ? a : b, in_order ? b : a});
    starts.sources.insert(starts.sources.end(), 2, static_cast<Id>(i));
  }
  const auto points = gradient.mesh.points();
  return find(gradient.mesh, detail::falling_simplices(gradient), edges, starts, [&](Id vertex) {
    const Id at = input[vertex];
    return std::array<double, 3>{points(at, 0), points(at, 1), points(at, 2)};
  });
}

DistributedSeparatrices find_ascending_separatrices(const DistributedGradient& gradient) {
  const CriticalSimplices& critical = gradient.local.critical();
  Starts starts;
  starts.simplices = critical.star;
  for (std::size_t i = 0; i < critical.triangles.size(); ++i)
    starts.sources.insert(starts.sources.end(), critical.star_begin[i + 1] - critical.star_begin[i],
                          static_cast<Id>(i));
  const auto tetrahedra = gradient.mesh.local().encoded().tetrahedra;
  const Id* const input = gradient.mesh.local().vertex_input().data();
  const auto points = gradient.mesh.points();
  return find(gradient.mesh, detail::rising_simplices(gradient), critical.triangles, starts, [&](Id tetrahedron) {
    std::array<double, 3> middle{};
    for (int corner = 0; corner < 4; ++corner) {
      for (int axis = 0; axis < 3; ++axis) middle[axis] += points(input[tetrahedra(tetrahedron, corner)], axis) / 4;
    }
    return middle;
  });
}

}  // namespace gale
