#include <gale/algorithms/morse_smale/separatrices1.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

namespace {

using HostSpace = Kokkos::DefaultHostExecutionSpace;

/// How many simplices a path of successors has; 0 if it leaves through the surface.
Offset length_of(const Id* successors, Id from) {
  Offset length = 1;
  for (Id next = successors[from]; next != no_id; next = successors[next], ++length) {
    if (DiscreteGradient::leaves(next)) return 0;
  }
  return length;
}

/// The path from each of `starts`, whose source is the one of `sources` at the same place. Its destination is
/// place(last) of its last simplex.
template <class Place>
Separatrices<Id> paths_of(const Id* successors, const std::vector<Id>& starts, const std::vector<Id>& sources,
                          const Place& place) {
  const Offset count = static_cast<Offset>(starts.size());
  const auto begin = allocate<Array<Offset, HostMemory>>("GALE::path_begin", count + 1);
  const auto rank = allocate<Array<Id, HostMemory>>("GALE::path_rank", count + 1);
  parallel_for("GALE::path_lengths", HostSpace(), count,
               [&](Offset i) { begin(i) = length_of(successors, starts[i]); });
  exclusive_scan("GALE::path_begins", HostSpace(), count, begin, [&](Offset i) { return begin(i); });
  exclusive_scan("GALE::count_paths", HostSpace(), count, rank, [&](Offset i) { return begin(i + 1) > begin(i); });
  Separatrices<Id> paths;
  paths.sources.resize(rank(count));
  paths.destinations.resize(rank(count));
  paths.begin.resize(rank(count) + 1);
  paths.cells.resize(begin(count));
  parallel_for("GALE::follow_paths", HostSpace(), count, [&](Offset i) {
    if (begin(i + 1) == begin(i)) return;
    Id* cell = paths.cells.data() + begin(i);
    for (*cell = starts[i]; successors[*cell] != no_id; ++cell) cell[1] = successors[*cell];
    paths.sources[rank(i)] = sources[i];
    paths.destinations[rank(i)] = place(*cell);
    paths.begin[rank(i) + 1] = begin(i + 1);
  });
  return paths;
}

}  // namespace

Separatrices<Id> descending_separatrices(const Mesh& mesh, const Array<const Id, HostMemory>& successors,
                                         const CriticalSimplices& critical, const CriticalPlaces& places) {
  const auto& edges = critical.edges;
  const Id* const input = mesh.vertex_input().data();
  std::vector<Id> starts, sources;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    const bool in_order = input[a] < input[b];
    starts.insert(starts.end(), {in_order ? a : b, in_order ? b : a});
    sources.insert(sources.end(), 2, static_cast<Id>(i));
  }
  return paths_of(successors.data(), starts, sources, [&](Id vertex) { return places.of_vertex(vertex); });
}

Separatrices<Id> ascending_separatrices(const Array<const Id, HostMemory>& successors,
                                        const CriticalSimplices& critical, const CriticalPlaces& places) {
  std::vector<Id> sources;
  for (std::size_t i = 0; i < critical.triangles.size(); ++i)
    sources.insert(sources.end(), critical.star_begin[i + 1] - critical.star_begin[i], static_cast<Id>(i));
  return paths_of(successors.data(), critical.star, sources,
                  [&](Id tetrahedron) { return places.of_tetrahedron(tetrahedron); });
}

}  // namespace gale::detail
