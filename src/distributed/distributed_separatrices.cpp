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

using detail::Point;

/// Where paths start, and from which of this rank's critical edges or triangles.
struct Starts {
  std::vector<Id> simplices;  ///< GALE's ids
  std::vector<Id> sources;    ///< places among the critical ones of this rank
};

/// The triangle of two tetrahedra.
std::array<Id, 3> shared_by(const std::array<Id, 4>& a, const std::array<Id, 4>& b) {
  std::array<Id, 3> both{};
  std::size_t found = 0;
  for (const Id vertex : a) {
    if (found < 3 && std::find(b.begin(), b.end(), vertex) != b.end()) both[found++] = vertex;
  }
  return both;
}

/// Simplices by GALE's ids of the local mesh, as users know them. Its functions refer to the gradient's arrays.
class Named {
 public:
  explicit Named(const DistributedMesh& mesh)
      : input_(mesh.local().vertex_input().data()), ids_(mesh.vertex_ids()), points_(mesh.points()) {}

  Point point_of(Id vertex) const { return detail::point_of(points_, input_[vertex]); }
  Point point_of(const std::array<Id, 4>& tetrahedron) const {
    return detail::barycentre(points_, detail::written(input_, tetrahedron));
  }

  /// The step at an edge or a triangle.
  template <std::size_t N>
  detail::PathStep step(const std::array<Id, N>& simplex) const {
    const auto input = detail::written(input_, simplex);
    detail::PathStep step;
    for (std::size_t k = 0; k < N; ++k) step.vertices[k] = ids_(input[k]);
    step.point = detail::position_of(points_, input);
    return step;
  }

 private:
  const Id* input_;
  Array<const GlobalId, HostMemory> ids_;
  Points<double, HostMemory> points_;
};

template <class Simplex>
std::vector<detail::PathStep> steps_of(const DistributedMesh& mesh, const std::vector<Simplex>& simplices) {
  std::vector<detail::PathStep> steps;
  detail::together(mesh.ranks(), [&] {
    const Named named(mesh);
    for (const Simplex& simplex : simplices) steps.push_back(named.step(simplex));
  });
  return steps;
}

/// The places of critical edges, or triangles, among those of all ranks.
detail::KeyPlaces places_of(const Communicator& ranks, const std::vector<detail::PathStep>& simplices) {
  Array<detail::SimplexKey, HostMemory> keys;
  detail::together(ranks, [&] {
    keys = allocate<decltype(keys)>("GALE::critical_keys", simplices.size());
    for (std::size_t i = 0; i < simplices.size(); ++i) keys(i) = simplices[i].vertices;
  });
  return detail::places_of_keys(ranks, keys);
}

/// `critical` are the sources that this rank has.
DistributedSeparatrices find(const Communicator& ranks, const detail::PathSimplices& simplices,
                             const std::vector<detail::PathStep>& critical, const Starts& starts,
                             const detail::PathShape& shape) {
  const detail::DistributedPaths paths(ranks, simplices);
  const auto destinations = detail::places_of_ends(ranks, paths);
  const detail::KeyPlaces sources = places_of(ranks, critical);
  const detail::WholePaths whole = detail::whole_paths(ranks, paths, starts.simplices, shape);
  DistributedSeparatrices found;
  detail::together(ranks, [&] {
    for (std::size_t i = 0; i < starts.simplices.size(); ++i) {
      if (whole.begin[i + 1] == whole.begin[i]) continue;
      found.sources.push_back(sources.places(starts.sources[i]));
      found.sources_here.push_back(starts.sources[i]);
      found.destinations.push_back(destinations(paths.end(starts.simplices[i])));
      found.begin.push_back(whole.begin[i + 1]);
      const detail::PathStep* before = &critical[starts.sources[i]];
      for (Offset k = whole.begin[i]; k < whole.begin[i + 1]; ++k) {
        found.between.push_back(before->vertices);
        found.between_points.push_back(before->point);
        before = &whole.cells[k].next;
      }
    }
    for (const detail::PathCell& cell : whole.cells) {
      found.cells.push_back(cell.id);
      found.points.push_back(cell.point);
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
  const Named named(gradient.mesh);
  const detail::PathShape shape{[named](Id vertex) { return named.point_of(vertex); },
                                [named](Id vertex, Id next) {
                                  return named.step(std::array<Id, 2>{vertex, next});
                                }};
  return find(gradient.mesh.ranks(), detail::falling_simplices(gradient), steps_of(gradient.mesh, edges), starts,
              shape);
}

DistributedSeparatrices find_ascending_separatrices(const DistributedGradient& gradient) {
  const CriticalSimplices& critical = gradient.local.critical();
  Starts starts;
  starts.simplices = critical.star;
  for (std::size_t i = 0; i < critical.triangles.size(); ++i)
    starts.sources.insert(starts.sources.end(), critical.star_begin[i + 1] - critical.star_begin[i],
                          static_cast<Id>(i));
  const auto tetrahedra = gradient.mesh.local().encoded().tetrahedra;
  const auto corners = [tetrahedra](Id t) {
    return std::array<Id, 4>{tetrahedra(t, 0), tetrahedra(t, 1), tetrahedra(t, 2), tetrahedra(t, 3)};
  };
  const Named named(gradient.mesh);
  const detail::PathShape shape{[=](Id t) { return named.point_of(corners(t)); },
                                [=](Id t, Id next) { return named.step(shared_by(corners(t), corners(next))); }};
  return find(gradient.mesh.ranks(), detail::rising_simplices(gradient), steps_of(gradient.mesh, critical.triangles),
              starts, shape);
}

}  // namespace gale
