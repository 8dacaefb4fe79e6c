#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale::detail {

namespace {

constexpr std::uint64_t no_pair = ~std::uint64_t(0);

/// Pairs of manifolds, ascending: those that occur.
struct ManifoldPairs {
  Mirrored<Id> of_vertex;         ///< which, by input id; no_id: none
  Mirrored<std::uint64_t> pairs;  ///< pair_key(ascending, descending) of each
};

/// Finds the pairs by sorting all vertices, as a device does.
template <class Space>
ManifoldPairs sorted_pairs(const Space& space, const Mirrored<Id>& ascending, const Mirrored<Id>& descending) {
  const Offset count = ascending.size();
  const auto up = ascending.in<MemoryOf<Space>>(), down = descending.in<MemoryOf<Space>>();
  const auto keys = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::manifold_pairs", count);
  const auto vertices = allocate<Array<Id, MemoryOf<Space>>>("GALE::manifold_vertices", count);
  parallel_for(
      "GALE::manifold_pairs", space, count, KOKKOS_LAMBDA(Offset v) {
        keys(v) = up(v) == no_id ? no_pair : pair_key(up(v), down(v));
        vertices(v) = static_cast<Id>(v);
      });
  stable_sort_by_key(space, keys, vertices);
  const auto before =
      allocate<Array<Id, MemoryOf<Space>>>("GALE::manifold_number", count + 1);  // how many pairs begin earlier
  const Id distinct = exclusive_scan(
      "GALE::count_manifolds", space, count, before,
      KOKKOS_LAMBDA(Offset i) { return keys(i) != no_pair && (i == 0 || keys(i) != keys(i - 1)); });
  const auto pairs = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::manifold_pairs", distinct);
  const auto manifolds = allocate<Array<Id, MemoryOf<Space>>>("GALE::morse_smale_manifolds", count);
  parallel_for(
      "GALE::morse_smale_manifolds", space, count, KOKKOS_LAMBDA(Offset i) {
        if (before(i + 1) > before(i)) pairs(before(i)) = keys(i);
        manifolds(vertices(i)) = keys(i) == no_pair ? no_id : before(i + 1) - 1;
      });
  space.fence();
  return {manifolds, pairs};
}

/// Finds the pairs by a table of each host thread's: there are few pairs beside vertices.
ManifoldPairs counted_pairs(const Mirrored<Id>& ascending, const Mirrored<Id>& descending) {
  const auto &up = ascending.in<HostMemory>(), &down = descending.in<HostMemory>();
  const Offset count = up.extent(0);
  const int parts = threads_for(count);
  std::vector<std::vector<std::uint64_t>> found(parts);  // by part, in the order in which it comes to them
  const auto manifolds = allocate<Array<Id, HostMemory>>("GALE::morse_smale_manifolds", count);
  for_parts("GALE::manifold_pairs", count, parts, [&](int part, Offset first, Offset last) {
    HashTable<Id> numbers;
    std::vector<std::uint64_t> pairs;
    std::uint64_t before = no_pair;  // of the vertex before: mostly this one's, too
    Id number = no_id;
    for (Offset v = first; v < last; ++v) {
      stop_if_asked_at(v);
      const std::uint64_t pair = up(v) == no_id ? no_pair : pair_key(up(v), down(v));
      if (pair != before) {
        before = pair;
        number = no_id;
        if (pair != no_pair) {
          const auto [known, is_new] = numbers.insert(pair);
          if (is_new) {
            known = static_cast<Id>(pairs.size());
            pairs.push_back(pair);
          }
          number = known;
        }
      }
      manifolds(v) = number;
    }
    found[part] = std::move(pairs);
  });
  std::vector<std::uint64_t> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  sort_distinct("GALE::sort_manifold_pairs", all);
  const auto pairs = array_of("GALE::manifold_pairs", all);
  for_parts("GALE::number_manifolds", count, parts, [&](int part, Offset first, Offset last) {
    std::vector<Id> numbers;
    for (const std::uint64_t pair : found[part])
      numbers.push_back(static_cast<Id>(std::lower_bound(all.begin(), all.end(), pair) - all.begin()));
    for (Offset v = first; v < last; ++v) {
      stop_if_asked_at(v);
      if (manifolds(v) != no_id) manifolds(v) = numbers[manifolds(v)];
    }
  });
  return {manifolds, pairs};
}

template <class Space>
ManifoldPairs pairs_in(const Space& space, const Mirrored<Id>& ascending, const Mirrored<Id>& descending) {
  if constexpr (is_device<Space>) {
    return sorted_pairs(space, ascending, descending);
  } else {
    return counted_pairs(ascending, descending);
  }
}

/// The pairs that this rank has numbered among themselves get their places among those of all.
std::pair<Mirrored<Id>, Id> pairs_on_ranks(const Ranks& ranks, const ManifoldPairs& here) {
  Array<SimplexKey, HostMemory> keys;
  together(ranks, [&] {
    const auto& pairs = here.pairs.in<HostMemory>();
    keys = allocate<decltype(keys)>("GALE::manifold_pairs", pairs.extent(0));
    for (std::size_t i = 0; i < pairs.extent(0); ++i) keys(i) = {pair_first(pairs(i)), pair_second(pairs(i)), 0};
  });
  const PlacesOfAll found = places_of_keys(ranks, keys);
  Mirrored<Id> all;
  together(ranks, [&] {
    require_ids("Morse-Smale manifolds of all ranks", found.count);
    all = renamed(here.of_vertex, std::vector<Id>(found.places.data(), found.places.data() + keys.extent(0)));
  });
  return {all, static_cast<Id>(found.count)};
}

}  // namespace

std::pair<Mirrored<Id>, Id> morse_smale_manifolds(const Mesh& mesh, const Mirrored<Id>& ascending,
                                                  const Mirrored<Id>& descending) {
  const Ranks& ranks = mesh.exchange().ranks();
  ManifoldPairs here;
  together(ranks, [&] {
    here = in_worker_or_host_space(ascending.on_device(),
                                   [&](const auto& space) { return pairs_in(space, ascending, descending); });
  });
  if (ranks.size() == 1) return {here.of_vertex, static_cast<Id>(here.pairs.size())};
  return pairs_on_ranks(ranks, here);
}

}  // namespace gale::detail
