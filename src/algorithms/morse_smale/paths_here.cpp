#include <algorithm>

#include <gale/algorithms/morse_smale/condensed_paths.hpp>
#include <gale/algorithms/morse_smale/first_cells.hpp>
#include <gale/algorithms/morse_smale/paths_here.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class Space>
using Ids = Array<Id, MemoryOf<Space>>;

/// The exits that paths come to. Copies share it.
template <class Memory>
struct ReachedExits {
  Id criticals;
  Array<char, Memory> is_reached;

  /// Marks the exit at which a path ends here, if it is one.
  KOKKOS_FUNCTION void mark(Id end) const {
    if (end >= criticals) atomic_write(&is_reached(end - criticals), char(1));
  }
};

/// Marks an exit that the path from another simplex comes to.
template <class Memory>
struct MarkReached {
  Array<const Id, Memory> ends, exits;
  ReachedExits<Memory> reached;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id end = place_of_end(ends(i));
    if (end >= reached.criticals && exits(end - reached.criticals) != i) reached.mark(end);
  }
};

/// Marks the exits that paths from other simplices come to; of many simplices at once none does, mostly.
template <class Space>
void mark_reached(const Space& space, const MarkReached<MemoryOf<Space>>& mark) {
  const Offset all = mark.ends.extent(0);
  if constexpr (is_device<Space>) {
    parallel_for("GALE::reached_exits", space, all, mark);
    space.fence();
  } else {
    constexpr Offset block = 64;
    const Id* const ends = mark.ends.data();
    for_parts("GALE::reached_exits", all, threads_for(all), [&](int, Offset first, Offset last) {
      for (Offset begin = first; begin < last; begin += block) {
        const Offset end = std::min(begin + block, last);
        Id least = 0;
        for (Offset i = begin; i < end; ++i) least = std::min(least, ends[i]);
        if (least > end_at(mark.reached.criticals)) continue;
        for (Offset i = begin; i < end; ++i) mark(i);
      }
    });
  }
}

/// Marks the exits that paths come to from some cells, or from those outside an interval.
template <class Memory>
struct MarkFromCells {
  EndOfPath<Memory> end;
  ReachedExits<Memory> reached;
  Array<const Id, Memory> cells;  ///< none: those outside
  Interval inner;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id cell = cells.extent(0) == 0 ? inner.outside(i) : cells(i);
    if (end.successors(cell) >= 0) reached.mark(end(cell));
  }
};

/// Follows the paths of all vertices.
template <class Space>
CondensedPaths<MemoryOf<Space>> follow_vertices(const Space& space, const PathSimplices& simplices,
                                                const Ids<Space>& exits, const ReachedExits<MemoryOf<Space>>& reached) {
  const Id criticals = reached.criticals;
  const Ids<Space> next = with_ends(space, simplices.successors(), simplices.critical());
  parallel_for(
      "GALE::name_exits", space, exits.extent(0),
      KOKKOS_LAMBDA(Offset i) { next(exits(i)) = end_at(criticals + static_cast<Id>(i)); });
  jump(space, next);
  mark_reached(space, MarkReached<MemoryOf<Space>>{next, exits, reached});
  return {next, {}, {}};
}

/// Follows the paths of owned vertices from their cells, and of cells that others share; `starts` become the entries.
template <class Space>
CondensedPaths<MemoryOf<Space>> follow_cells(const Space& space, const PathSimplices& simplices,
                                             const Ids<Space>& exits, const ReachedExits<MemoryOf<Space>>& reached,
                                             const Ids<Space>& starts) {
  using Memory = MemoryOf<Space>;
  const auto paths = condensed_paths(space, simplices.successors(), simplices.critical(), starts, exits);
  jump(space, paths.next);
  const auto successors = simplices.successors().in<Memory>();
  const EndOfPath<Memory> end{paths.next, paths.words, paths.before, successors};
  const Interval inner = simplices.inner(), owned = simplices.mesh().owned_vertices();
  const bool is_grid = simplices.mesh().grid() != nullptr;
  const Momentary<const Id, Memory> shared("GALE::shared_cells", simplices.shared());
  parallel_for("GALE::reached_exits", space,
               is_grid ? static_cast<Offset>(successors.extent(0)) - inner.size() : simplices.shared().extent(0),
               MarkFromCells<Memory>{end, reached, shared.array(), inner});
  parallel_for(
      "GALE::reached_exits", space, owned.size(), KOKKOS_LAMBDA(Offset i) {
        const Id entry = starts(owned.first + static_cast<Id>(i));
        if (entry != no_id) reached.mark(place_of_end(end.ends(entry)));
      });
  space.fence();
  return paths;
}

template <class Space>
PathsHere follow_in(const Space& space, const PathSimplices& simplices, const std::vector<Id>& others) {
  using Memory = MemoryOf<Space>;
  const auto successors = simplices.successors().in<Memory>();
  const Interval inner = simplices.inner();
  const Ids<Space> exits = selected(
      "GALE::find_exits", space, static_cast<Offset>(successors.extent(0)) - inner.size(),
      KOKKOS_LAMBDA(Offset i) { return successors(inner.outside(i)) == DiscreteGradient::elsewhere; });
  parallel_for(
      "GALE::find_exits", space, exits.extent(0), KOKKOS_LAMBDA(Offset i) { exits(i) = inner.outside(exits(i)); });
  const ReachedExits<Memory> reached{static_cast<Id>(simplices.critical().size()),
                                     allocate<Array<char, Memory>>("GALE::reached_exits", exits.extent(0))};
  fill("GALE::reached_exits", space, reached.is_reached, char(0));
  const Ids<Space> starts = simplices.are_vertices() ? Ids<Space>() : first_cells(space, simplices.mesh());
  const auto paths = simplices.are_vertices() ? follow_vertices(space, simplices, exits, reached)
                                              : follow_cells(space, simplices, exits, reached, starts);
  const EndOfPath<Memory> end{paths.next, paths.words, paths.before, successors};
  const Momentary<const Id, Memory> given("GALE::other_paths",
                                          Array<const Id, HostMemory>(others.data(), others.size()));
  const Array<const Id, Memory> more = given.array();
  parallel_for(
      "GALE::reached_exits", space, more.extent(0), KOKKOS_LAMBDA(Offset i) { reached.mark(end(more(i))); });
  const Ids<Space> found = selected(
      "GALE::reached_exits", space, exits.extent(0), KOKKOS_LAMBDA(Offset i) { return reached.is_reached(i) != 0; });
  space.fence();
  return {on_host(exits), {paths.next, paths.words, paths.before}, starts, on_host(found)};
}

}  // namespace

PathsHere follow_here(const PathSimplices& simplices, const std::vector<Id>& others) {
  return in_worker_or_host_space(simplices.successors().on_device(),
                                 [&](const auto& space) { return follow_in(space, simplices, others); });
}

std::vector<Id> ends_of(const EndsHere& ends, const PathSimplices& all, const std::vector<Id>& simplices) {
  return in_worker_or_host_space(ends.of_entries.on_device(), [&](const auto& space) {
    using Memory = MemoryOf<std::decay_t<decltype(space)>>;
    return results_at("GALE::ends_of", space, simplices,
                      EndOfPath<Memory>{ends.of_entries.in<Memory>(), ends.words.in<Memory>(), ends.before.in<Memory>(),
                                        all.successors().in<Memory>()});
  });
}

}  // namespace gale::detail
