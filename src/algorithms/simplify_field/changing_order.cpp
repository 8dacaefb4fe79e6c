#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include <gale/algorithms/simplify_field/changing_order.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// Places in an order as a side counts them.
struct TurnedPlaces {
  Id count;
  Side side;

  KOKKOS_FORCEINLINE_FUNCTION Offset operator()(Offset rank) const { return side == below ? rank : count - 1 - rank; }
};

/// What becomes filled: for each vertex the saddle that it follows, and as the how manyth.
struct FilledVertices {
  std::vector<Id> vertices, saddles, places;
  std::vector<Id> all_saddles, lengths;  ///< each saddle once, and how many follow it with itself

  explicit FilledVertices(const std::vector<FilledBranch>& branches) {
    std::vector<Id> sorted(branches.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = static_cast<Id>(i);
    std::stable_sort(sorted.begin(), sorted.end(), [&](Id a, Id b) { return branches[a].saddle < branches[b].saddle; });
    for (const Id number : sorted) {
      const FilledBranch& branch = branches[number];
      if (all_saddles.empty() || all_saddles.back() != branch.saddle) {
        all_saddles.push_back(branch.saddle);
        lengths.push_back(1);
      }
      for (const Id vertex : branch.vertices) {
        vertices.push_back(vertex);
        saddles.push_back(branch.saddle);
        places.push_back(lengths.back()++);
      }
    }
  }
};

/// Puts filled vertices where they belong. `by_rank` has changed places with `before`, which has the order as it was.
template <class Space>
void put_filled(const Space& space, const TurnedPlaces& turned, const FilledVertices& filled,
                const Array<std::uint64_t, MemoryOf<Space>>& rank, const Array<Id, MemoryOf<Space>>& by_rank,
                const Array<Id, MemoryOf<Space>>& before, const Array<Id, MemoryOf<Space>>& new_place) {
  using Memory = MemoryOf<Space>;
  const auto vertices = in_memory<Memory>(filled.vertices), saddles = in_memory<Memory>(filled.saddles),
             places = in_memory<Memory>(filled.places), all_saddles = in_memory<Memory>(filled.all_saddles),
             lengths = in_memory<Memory>(filled.lengths);
  const auto count = static_cast<Offset>(filled.vertices.size());
  const auto saddle_place = allocate<Array<Id, Memory>>("GALE::places_of_saddles", count);
  fill("GALE::clear_places", space, new_place, 1);
  parallel_for(
      "GALE::leave_places", space, count, KOKKOS_LAMBDA(Offset i) {
        saddle_place(i) = static_cast<Id>(turned(static_cast<Offset>(rank(saddles(i)))));
        new_place(turned(static_cast<Offset>(rank(vertices(i))))) = 0;
      });
  parallel_for(
      "GALE::lengthen_places", space, static_cast<Offset>(all_saddles.extent(0)),
      KOKKOS_LAMBDA(Offset i) { new_place(turned(static_cast<Offset>(rank(all_saddles(i))))) = lengths(i); });
  exclusive_scan("GALE::new_places", space, Offset(turned.count), new_place, new_place);
  parallel_for(
      "GALE::new_ranks", space, Offset(turned.count), KOKKOS_LAMBDA(Offset i) {
        if (new_place(i + 1) == new_place(i)) return;
        const Id vertex = before(turned(i));
        const Offset to = turned(new_place(i));
        by_rank(to) = vertex;
        rank(vertex) = static_cast<std::uint64_t>(to);
      });
  parallel_for(
      "GALE::ranks_of_filled", space, count, KOKKOS_LAMBDA(Offset i) {
        const Offset to = turned(new_place(saddle_place(i)) + places(i));
        by_rank(to) = vertices(i);
        rank(vertices(i)) = static_cast<std::uint64_t>(to);
      });
  space.fence();
}

/// Writes the ranks that follow from an order.
template <class Space>
void write_ranks(const Space& space, Offset count, const Array<Id, MemoryOf<Space>>& by_rank,
                 const Array<std::uint64_t, MemoryOf<Space>>& rank) {
  parallel_for(
      "GALE::ranks", space, count, KOKKOS_LAMBDA(Offset i) { rank(by_rank(i)) = static_cast<std::uint64_t>(i); });
  space.fence();
}

/// Sets some entries.
template <class Space>
void set_some(const Space& space, const std::vector<Id>& places, const std::vector<Id>& values,
              const Array<Id, MemoryOf<Space>>& entries) {
  const auto to = in_memory<MemoryOf<Space>>(places), from = in_memory<MemoryOf<Space>>(values);
  parallel_for(
      "GALE::set_some", space, static_cast<Offset>(places.size()),
      KOKKOS_LAMBDA(Offset i) { entries(to(i)) = from(i); });
  space.fence();
}

}  // namespace

template <class Space>
ChangingOrder<Space>::ChangingOrder(const Space& space, const VertexOrder& order, ExtremumGraph<Memory> graph,
                                    ChangedStars stars, int threads)
    : space_(space), threads_(threads), graph_(std::move(graph)), stars_(std::move(stars)) {
  const Id count = order.mesh().vertices();
  const auto keys = allocate<Array<std::uint64_t, Memory>>("GALE::sorted_keys", count);
  Kokkos::deep_copy(keys, order.template keys_in<Memory>());
  by_rank_ = allocate<Array<Id, Memory>>("GALE::vertices_by_rank", count + Offset(1));
  parallel_for("GALE::iota", space, count + Offset(1), WritePlace<Array<Id, Memory>>{by_rank_});
  stable_sort_by_key(space, keys, Array<Id, Memory>(first_of(by_rank_, count)));
  rank_ = keys;
  write_ranks(space, count, by_rank_, rank_);
  value_of_ = iota("GALE::value_of", HostExecutionSpace(), count);
  if constexpr (is_device<Space>) known_ = ZeroedRoom<std::uint64_t>(count);
}

template <class Space>
std::vector<std::uint64_t> ChangingOrder<Space>::keys_of(const std::vector<Id>& some) const {
  return results_at("GALE::some_keys", space_, some, EntryAt<std::uint64_t, Memory>{rank_});
}

/// The keys on the host, those of these vertices at least.
template <class Space>
const std::uint64_t* ChangingOrder<Space>::keys_on_host(const std::vector<Id>& of) {
  if constexpr (is_device<Space>) {
    const std::vector<std::uint64_t> keys = keys_of(of);
    for (std::size_t i = 0; i < of.size(); ++i) known_[of[i]] = keys[i];
    return known_.data();
  } else {
    return rank_.data();
  }
}

template <class Space>
void ChangingOrder<Space>::fill(Side side, std::vector<FilledBranch> branches, ChangingRoom<Memory>& room) {
  std::vector<Id> changed;
  for (const FilledBranch& branch : branches) {
    changed.push_back(branch.saddle);
    changed.insert(changed.end(), branch.vertices.begin(), branch.vertices.end());
  }
  sort_distinct("GALE::sort_changed", changed);
  stars_.gather(std::move(changed), threads_);
  branch_.assign(stars_.vertices().size(), no_id);
  for (std::size_t number = 0; number < branches.size(); ++number) {
    for (const Id vertex : branches[number].vertices) branch_[stars_.place(vertex)] = static_cast<Id>(number);
  }
  const SideKeys keys(keys_on_host(stars_.vertices()), side);
  in_turns(threads_, static_cast<std::int64_t>(branches.size()),
           [&](int, std::int64_t i) { flood(keys, branches[i], static_cast<Id>(i)); });
  reorder(side, branches, room);
  update_graph();
}

/// From the saddle on, what the side comes to first among all that touches what was flooded: so what rises goes on
/// rising, and few vertices become extrema of the other side.
template <class Space>
void ChangingOrder<Space>::flood(const SideKeys& keys, FilledBranch& branch, Id number) {
  using Entry = std::pair<std::uint64_t, Id>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  const auto reach = [&](Id from) {
    for (const Id neighbour : stars_.neighbours(stars_.place(from))) {
      const Id place = stars_.place(neighbour);
      if (place == no_id || branch_[place] != number) continue;
      branch_[place] = no_id;
      next.emplace(keys[neighbour], neighbour);
    }
  };
  std::size_t flooded = 0;
  for (reach(branch.saddle); !next.empty(); ++flooded) {
    stop_if_asked_at(static_cast<std::int64_t>(flooded));
    const Id vertex = next.top().second;
    next.pop();
    branch.vertices[flooded] = vertex;
    reach(vertex);
  }
}

template <class Space>
void ChangingOrder<Space>::reorder(Side side, const std::vector<FilledBranch>& branches, ChangingRoom<Memory>& room) {
  for (const auto& [saddle, vertices] : branches) {
    for (const Id vertex : vertices) value_of_(vertex) = value_of_(saddle);
  }
  std::swap(by_rank_, room.vertices_before);
  const TurnedPlaces turned{static_cast<Id>(rank_.extent(0)), side};
  put_filled(space_, turned, FilledVertices(branches), rank_, by_rank_, room.vertices_before, room.places);
}

template <class Space>
void ChangingOrder<Space>::update_graph() {
  const auto changes = [&](Id vertex) { return stars_.place(vertex) != no_id; };
  for (auto& side : graph_) {
    side.extrema.erase(std::remove_if(side.extrema.begin(), side.extrema.end(), changes), side.extrema.end());
    side.meetings.erase(std::remove_if(side.meetings.begin(), side.meetings.end(),
                                       [&](const Meeting& meeting) { return changes(meeting.vertex); }),
                        side.meetings.end());
  }
  const std::vector<Id>& vertices = stars_.vertices();
  keys_on_host(stars_.all_neighbours());
  std::vector<ExtremumFinder> finders(threads_, ExtremumFinder(keys_on_host(vertices)));
  std::vector<Id> next[2];
  for (auto& side : next) side.resize(vertices.size());
  for_parts("GALE::graph_of_changed", static_cast<Offset>(vertices.size()), threads_,
            [&](int part, Offset begin, Offset end) {
              for (Offset i = begin; i < end; ++i) {
                stop_if_asked_at(i);
                const auto found = finders[part].visit(vertices[i], stars_.neighbours(i), stars_.link(i));
                for (const Side side : {below, above}) next[side][i] = found[side];
              }
            });
  for (const Side side : {below, above}) set_some(space_, vertices, next[side], graph_[side].next);
  add_found(finders, graph_);
}

#define GALE_INSTANTIATE(Space) template class ChangingOrder<Space>
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
