#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/persistence/path_ends.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

namespace {

/// The critical simplex at which a path ends; less than no_id if it leaves through the surface.
Id end_of(const Id* successors, Id at) {
  for (Id next = successors[at]; next != no_id; next = successors[at]) {
    if (DiscreteGradient::leaves(next)) return next;
    at = next;
  }
  return at;
}

}  // namespace

PathEnds ends_of_edges(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const auto& edges = gradient.critical().edges;
  const Id* const successors = gradient.vertex_successors().data();
  PathEnds ends(edges.size());
  parallel_for("GALE::ends_of_edges", HostExecutionSpace(), edges.size(), [&](Offset i) {
    for (int k = 0; k < 2; ++k) ends[i][k] = places.of_vertex(end_of(successors, edges[i][k]));
  });
  return ends;
}

PathEnds ends_of_triangles(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const CriticalSimplices& critical = gradient.critical();
  const Id* const successors = gradient.tetrahedron_successors().data();
  PathEnds ends(critical.triangles.size(), {no_id, no_id});
  parallel_for("GALE::ends_of_triangles", HostExecutionSpace(), ends.size(), [&](Offset i) {
    const Id first = critical.star_begin[i], count = critical.star_begin[i + 1] - first;
    for (Id k = 0; k < count && count <= 2; ++k) {
      const Id end = end_of(successors, critical.star[first + k]);
      ends[i][k] = end < no_id ? no_id : places.of_tetrahedron(end);
    }
  });
  return ends;
}

bool forks(const DiscreteGradient& gradient) {
  const auto& begin = gradient.critical().star_begin;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    if (begin[i + 1] - begin[i] > 2) return true;
  }
  return !gradient.store().further_successors.empty();
}

}  // namespace gale::detail
