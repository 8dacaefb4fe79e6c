#include <type_traits>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// The simplices of the path from each start, those of the i-th from begin(i) on; none if it leaves through the
/// surface.
struct Followed {
  Array<const Offset, HostMemory> begin;
  std::vector<Id> simplices;
};

/// Follows paths where successors lie on a device.
template <class Space, class Successors>
Followed paths_on_device(const Space& space, const Successors& successors, const std::vector<Id>& starts) {
  const auto paths = follow_whole(space, successors, starts, false);
  return {on_host(paths.begin), vector_of(paths.simplices)};
}

/// Follows paths on the host, of which those that leave through the surface are walked twice for nothing.
template <class Successors>
Followed paths_on_host(const Successors& successors, const std::vector<Id>& starts) {
  const Offset count = static_cast<Offset>(starts.size());
  const auto start = [&](Offset i) { return starts[i]; };
  const auto begin = allocate<Array<Offset, HostMemory>>("GALE::path_begin", count + 1);
  walk_each_on_host(
      "GALE::path_lengths", successors, count, start, [](Offset, Offset, Id) {},
      [&](Offset i, Offset length, Id, Id next) { begin(i) = next == no_id ? length : 0; });
  const Offset total = exclusive_scan("GALE::path_begins", HostExecutionSpace(), count, begin, begin);
  std::vector<Id> simplices;
  reserve(simplices, total);
  simplices.resize(total);
  walk_each_on_host(
      "GALE::follow_paths", successors, count, start,
      [&](Offset i, Offset k, Id simplex) {
        if (begin(i + 1) > begin(i)) simplices[begin(i) + k] = simplex;
      },
      [](Offset, Offset, Id, Id) {});
  return {begin, std::move(simplices)};
}

/// Follows paths where the successors are, if there is room.
Followed follow(const Mirrored<Id>& successors, const std::vector<Id>& starts) {
  return in_worker_or_host_space(successors.on_device(), [&](const auto& space) -> Followed {
    using Space = std::decay_t<decltype(space)>;
    if constexpr (is_device<Space>) {
      return paths_on_device(space, successors.in<MemoryOf<Space>>(), starts);
    } else {
      return paths_on_host(successors.in<HostMemory>().data(), starts);
    }
  });
}

/// The path from each of `starts`, whose source is the one of `sources` at the same place. Its destination is
/// place(last) of its last simplex.
template <class Place>
Separatrices<Id> paths_of(Followed followed, const std::vector<Id>& sources, const Place& place) {
  const Offset count = static_cast<Offset>(sources.size());
  const auto rank = allocate<Array<Id, HostMemory>>("GALE::path_rank", count + 1);
  const auto is_there = [&](Offset i) { return followed.begin(i + 1) > followed.begin(i); };
  const Id paths_there = exclusive_scan("GALE::count_paths", HostExecutionSpace(), count, rank, is_there);
  Separatrices<Id> paths;
  paths.sources.resize(paths_there);
  paths.destinations.resize(paths_there);
  paths.begin.resize(paths_there + 1);
  paths.cells = std::move(followed.simplices);
  parallel_for("GALE::name_paths", HostExecutionSpace(), count, [&](Offset i) {
    if (!is_there(i)) return;
    const Offset end = followed.begin(i + 1);
    paths.sources[rank(i)] = sources[i];
    paths.destinations[rank(i)] = place(paths.cells[end - 1]);
    paths.begin[rank(i) + 1] = end;
  });
  return paths;
}

/// These paths, each as far as the first simplex that an earlier one passes. Sequential: as many steps as there are
/// simplices in the result, and on ways that leave through the surface.
template <class Place>
Separatrices<Id> joined_paths_of(const Id* successors, const std::vector<Id>& starts, const std::vector<Id>& sources,
                                 const Place& place) {
  Separatrices<Id> paths;
  HashTable<Id> passed;  // by simplex: the first path there; no_id if the way leaves through the surface
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t first = paths.cells.size();
    Id destination = no_id, joined = no_id;
    for (Id cell = starts[i]; cell >= 0; cell = successors[cell]) {
      paths.cells.push_back(cell);
      const auto [path, is_new] = passed.insert(static_cast<std::uint64_t>(cell));
      if (!is_new) {
        joined = path;
        destination = joined == no_id ? no_id : paths.destinations[joined];
        break;
      }
      path = paths.count();
      if (successors[cell] == no_id) destination = place(cell);
    }
    if (destination == no_id) {
      for (std::size_t k = first; k < paths.cells.size(); ++k)
        passed.insert(static_cast<std::uint64_t>(paths.cells[k])).first = no_id;
      paths.cells.resize(first);
      continue;
    }
    paths.sources.push_back(sources[i]);
    paths.destinations.push_back(destination);
    paths.joins.push_back(joined != no_id);
    paths.begin.push_back(static_cast<Offset>(paths.cells.size()));
  }
  return paths;
}

template <class Place>
Separatrices<Id> paths_from(const Mirrored<Id>& successors, const PathStarts& starts, Paths told, const Place& place) {
  const auto& [simplices, sources] = starts;
  if (told == Paths::joined) return joined_paths_of(successors.in<HostMemory>().data(), simplices, sources, place);
  return paths_of(follow(successors, simplices), sources, place);
}

}  // namespace

PathStarts descending_starts(const Mesh& mesh, const CriticalSimplices& critical) {
  const OtherIds input = mesh.vertices_in_input();
  PathStarts starts;
  reserve(starts.simplices, 2 * critical.edges.size());
  reserve(starts.sources, 2 * critical.edges.size());
  for (std::size_t i = 0; i < critical.edges.size(); ++i) {
    const auto [a, b] = critical.edges[i];
    const bool in_order = input[a] < input[b];
    starts.simplices.insert(starts.simplices.end(), {in_order ? a : b, in_order ? b : a});
    starts.sources.insert(starts.sources.end(), 2, static_cast<Id>(i));
  }
  return starts;
}

PathStarts ascending_starts(const CriticalSimplices& critical) {
  PathStarts starts{critical.star, {}};
  reserve(starts.sources, critical.star.size());
  for (std::size_t i = 0; i + 1 < critical.star_begin.size(); ++i)
    starts.sources.insert(starts.sources.end(), critical.star_begin[i + 1] - critical.star_begin[i],
                          static_cast<Id>(i));
  return starts;
}

Separatrices<Id> paths_along(const MoreSuccessors& successors, const PathStarts& starts,
                             const std::function<Id(Id)>& place) {
  auto followed = in_worker_or_host_space(successors.own.on_device(), [&](const auto& space) -> Followed {
    using Space = std::decay_t<decltype(space)>;
    const SuccessorsIn<MemoryOf<Space>> here(successors);
    if constexpr (is_device<Space>) {
      return paths_on_device(space, here.all(), starts.simplices);
    } else {
      return paths_on_host(here.all(), starts.simplices);
    }
  });
  return paths_of(std::move(followed), starts.sources, place);
}

Separatrices<Id> descending_separatrices(const Mesh& mesh, const Mirrored<Id>& successors,
                                         const CriticalSimplices& critical, const CriticalPlaces& places, Paths told) {
  return paths_from(successors, descending_starts(mesh, critical), told,
                    [&](Id vertex) { return places.of_vertex(vertex); });
}

Separatrices<Id> ascending_separatrices(const Mirrored<Id>& successors, const CriticalSimplices& critical,
                                        const CriticalPlaces& places, Paths told) {
  return paths_from(successors, ascending_starts(critical), told,
                    [&](Id tetrahedron) { return places.of_cell(tetrahedron); });
}

}  // namespace gale::detail
