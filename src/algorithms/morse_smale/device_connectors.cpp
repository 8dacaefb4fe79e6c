#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale/growing_walls.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class T>
using Given = Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>;

/// Puts critical triangles at the beginning, and leaves them open.
void begin_walls(const WorkerSpace& space, const InWorkers<const Id>& vertices, const WallSink& sink) {
  parallel_for(
      "GALE::begin_walls", space, sink.walls, KOKKOS_LAMBDA(Offset i) {
        sink.critical(i) = {vertices(3 * i), vertices(3 * i + 1), vertices(3 * i + 2), static_cast<Id>(i)};
        sink.open(i) = static_cast<std::uint32_t>(i);
      });
}

/// Has walls have another table of edges, and what goes by the places there. Both have the same edges then, and
/// triangles are numbered anew: those from `first` on that are open, too.
void move_edges(const WorkerSpace& space, const WallSink& from, const WallSink& to, Offset first, Offset open) {
  parallel_for(
      "GALE::move_wall_edges", space, from.edges.places(), KOKKOS_LAMBDA(Offset place) {
        const std::uint64_t key = from.edges.at(place);
        bool is_new;
        if (key != KeyTable::none) to.triangles(to.edges.insert(key, is_new)) = from.triangles(place);
      });
  parallel_for(
      "GALE::move_open_triangles", space, open - first, KOKKOS_LAMBDA(Offset i) {
        std::uint32_t& number = to.open(first + i);
        if (!from.is_critical(number)) number = to.number_of(to.edges.find(from.edges.at(from.place_of(number))));
      });
  space.fence();
}

/// Finishes walls that have grown.
void finish_walls(const WorkerSpace& space, const GrownWalls& walls) {
  parallel_for(
      "GALE::finish_walls", space, walls.sink.walls + walls.sink.edges.places(),
      KOKKOS_LAMBDA(Offset i) { walls.finish(i); });
}

template <class T>
void append(std::vector<T>& entries, const InWorkers<T>& more) {
  auto there = vector_of(more);
  if (entries.empty()) {
    entries = std::move(there);
  } else {
    entries.insert(entries.end(), there.begin(), there.end());
  }
}

/// Finds the places of critical edges among these, by their ends, the higher one first. Throws OutOfMemory.
IdTable places_of(const WorkerSpace& space, const std::vector<std::array<Id, 2>>& edges) {
  const Offset count = static_cast<Offset>(edges.size());
  const IdTable places("GALE::edge_places", space, count);
  if (edges.empty()) return places;
  const auto ends = in_memory<WorkerMemory>(Given<Id>(edges[0].data(), 2 * edges.size()));
  parallel_for(
      "GALE::edge_places", space, count,
      KOKKOS_LAMBDA(Offset i) { places.set(pair_key(ends(2 * i), ends(2 * i + 1)), static_cast<Id>(i)); });
  space.fence();
  return places;
}

/// Rims in the order of walls, and of the places of their edges.
struct SortedRims {
  InWorkers<Id> rims;          ///< their places in what was sorted
  InWorkers<Id> walls, edges;  ///< of these
};

/// Sorts rims, which come in no order. Throws OutOfMemory.
SortedRims sorted_rims(const WorkerSpace& space, const InWorkers<WallRim>& rims, const IdTable& places) {
  const Offset count = static_cast<Offset>(rims.extent(0));
  const auto keys = allocate<InWorkers<std::uint64_t>>("GALE::rim_keys", count);
  const SortedRims all{iota("GALE::sorted_rims", space, static_cast<Id>(count)),
                       allocate<InWorkers<Id>>("GALE::walls_of_rims", count),
                       allocate<InWorkers<Id>>("GALE::edges_of_rims", count)};
  parallel_for(
      "GALE::rim_keys", space, count, KOKKOS_LAMBDA(Offset i) {
        const WallRim& rim = rims(i);
        keys(i) = pair_key(rim.wall, places.at(places.find(pair_key(rim.high, rim.low))));
      });
  stable_sort_by_key(space, keys, all.rims);
  parallel_for(
      "GALE::ends_of_rims", space, count, KOKKOS_LAMBDA(Offset i) {
        all.walls(i) = pair_first(keys(i));
        all.edges(i) = pair_second(keys(i));
      });
  space.fence();
  return all;
}

/// Appends the path from each of the rims up to the wall's critical triangle, which it includes. Sources and
/// destinations are the caller's.
void append_paths(const WorkerSpace& space, const GrownWalls& walls, const InWorkers<Id>& order,
                  FoundConnectors& found) {
  const Offset count = static_cast<Offset>(order.extent(0));
  const auto begin = allocate<InWorkers<Offset>>("GALE::connector_begin", count + 1);
  const auto is_only = allocate<InWorkers<std::uint8_t>>("GALE::connector_is_only", count);
  parallel_for(
      "GALE::connector_lengths", space, count, KOKKOS_LAMBDA(Offset i) {
        Offset length = 0;
        bool only = true;
        walls.climb(walls.rims(order(i)), [&](std::uint32_t, bool are_several) {
          ++length;
          only &= !are_several;
        });
        begin(i) = length;
        is_only(i) = only;
      });
  const Offset total = exclusive_scan("GALE::connector_begins", space, count, begin, begin);
  const auto cells = allocate<InWorkers<TriangleVertices>>("GALE::connector_cells", total);
  parallel_for(
      "GALE::follow_connectors", space, count, KOKKOS_LAMBDA(Offset i) {
        Offset at = begin(i);
        walls.climb(walls.rims(order(i)), [&](std::uint32_t number, bool) {
          const WallTriangle& triangle = walls.sink.triangle(number);
          cells(at++) = {triangle.high, triangle.low, triangle.third};
        });
      });
  space.fence();
  const auto begin_here = on_host(begin);
  const Offset before = found.paths.begin.back();
  for (Offset i = 0; i < count; ++i) found.paths.begin.push_back(before + begin_here(i + 1));
  append(found.paths.is_only, is_only);
  found.triangles.push_back(cells);
}

/// Says that walls have more edges together than they may have, however much memory there is.
class TooManyEdges : public OutOfMemory {
 public:
  using OutOfMemory::OutOfMemory;
};

/// Finds connectors in the descending walls of critical triangles, of which some grow side by side. Time and memory
/// grow with all walls together.
class Connectors {
 public:
  Connectors(const WallRows& rows, const CriticalSimplices& critical, Offset most_together)
      : critical_(critical.triangles),
        places_(places_of(space_, critical.edges)),
        most_together_(most_together),
        rows_(rows) {
    found.names = rows.names;
    found_.keys.bits = bits_for(rows.edges());
    found_.counts = allocate<InWorkers<WallCounts>>("GALE::wall_counts", 1);
  }

  /// Appends those of some critical triangles: in halves, if their walls together are too many.
  void add(Id begin, Id end) {
    const Id size = end - begin;
    if (size < Offset(1) << std::min(63 - found_.keys.bits, 30)) {  // walls that keys can number
      try {
        add_paths(begin, grow(begin, size, size > 1 ? most_together_ : WallTable::most_triangles));
        return;
      } catch (const TooManyEdges&) {
        if (size == 1) throw;
      } catch (const OutOfMemory&) {
        if (!found.triangles.empty()) {  // the memory that these take may suffice
          found.bring();
          return add(begin, end);
        }
        if (size == 1) throw;
      }
    }
    add(begin, begin + size / 2);
    add(begin + size / 2, end);
  }

  FoundConnectors found;

 private:
  GrownWalls grow(Id first_wall, Id count, Offset most_edges) {
    begin(critical_.data() + first_wall, count);
    while (counts_.part.end < counts_.open) {
      stop_if_asked();
      const Offset open = counts_.open - counts_.part.end;
      reserve(counts_.part.end, open, most_edges);
      launch_chain("GALE::grow_walls", space_, open, GrowWalls{rows_, found_});
      counts_ = counted(space_, found_.counts);
      if (counts_.edges > most_edges) throw TooManyEdges("walls of more than " + std::to_string(most_edges) + " edges");
    }
    const GrownWalls grown{rows_, found_, WallTable(space_, found_.edges.places()),
                           allocate<InWorkers<WallRim>>("GALE::wall_rims", counts_.rims)};
    finish_walls(space_, grown);
    return grown;
  }

  void begin(const TriangleVertices* critical, Id count) {
    found_.walls = count;
    found_.critical = {};  // of other walls
    found_.triangles = {};
    found_.open = {};
    found_.edges = {};
    counts_ = {0, 0, count, {}};
    found_.critical = allocate<InWorkers<WallTriangle>>("GALE::critical_triangles", count);
    found_.open = allocate<InWorkers<std::uint32_t>>("GALE::open_triangles", count);
    Kokkos::deep_copy(space_, found_.counts, Given<WallCounts>(&counts_, 1));
    begin_walls(space_, in_memory<WorkerMemory>(Given<Id>(critical->data(), 3 * static_cast<std::size_t>(count))),
                found_);
    space_.fence();
  }

  /// Makes room for what a chain's first launch of so many threads finds in half of the steps that it may take, where
  /// there is so much, else in one, as where these were more edges than there may be. Throws OutOfMemory.
  void reserve(Offset first, Offset threads, Offset most_edges) {
    const Offset in_some = threads * StepsOfLaunch::found_in(StepsOfLaunch::most_of(threads) / 2);
    const Offset later = std::min(counts_.edges, most_edges - counts_.edges - in_some);
    if (later < 0 || !has_made_room_for(in_some, first, later))
      make_room_for(threads * StepsOfLaunch::found_in(1), first, 0, EdgesInKernels::few_passed);
  }

  bool has_made_room_for(Offset more, Offset first, Offset later) {
    try {
      const bool are_all = found_.walls == static_cast<Id>(critical_.size());
      make_room_for(more, first, later,
                    are_all ? EdgesInKernels::usual_passed(rows_.edges()) : EdgesInKernels::few_passed);
      return true;
    } catch (const OutOfMemory&) {
      return false;
    }
  }

  /// Makes room for so many more edges and open triangles, and `least` of each in all; where the table has to grow, for
  /// `later` edges besides, as it takes time to move what is there.
  void make_room_for(Offset more, Offset first, Offset later, Offset least) {
    constexpr Offset most_places = Offset(1) << 30;
    make_room(space_, "GALE::open_triangles", found_.open, counts_.open, std::max(counts_.open + more, least));
    const Offset edges = counts_.edges + more;
    if (edges <= found_.edges.room()) return;
    const Offset places = KeyTable::places_for(std::max(edges + later, least));
    if (places > most_places) throw OutOfMemory("walls of " + std::to_string(edges + later) + " edges");
    WallSink larger = found_;
    larger.edges = KeyTable(space_, places);
    larger.triangles = allocate<InWorkers<WallTriangle>>("GALE::wall_triangles", places);
    move_edges(space_, found_, larger, first, counts_.open);
    found_ = larger;
  }

  /// Appends the connectors of walls that have grown, by walls and edges; nothing if it throws OutOfMemory.
  void add_paths(Id first, const GrownWalls& walls) {
    const SortedRims rims = sorted_rims(space_, walls.rims, places_);
    append_paths(space_, walls, rims.rims, found);
    append(found.paths.sources, rims.edges);
    const std::size_t before = found.paths.destinations.size();
    append(found.paths.destinations, rims.walls);
    for (std::size_t i = before; i < found.paths.destinations.size(); ++i) found.paths.destinations[i] += first;
  }

  const WorkerSpace space_{};
  const std::vector<TriangleVertices>& critical_;
  const IdTable places_;
  const Offset most_together_;
  const WallRows rows_;
  WallSink found_;
  WallCounts counts_;
};

}  // namespace

void FoundConnectors::bring() {
  for (const auto& part : triangles) append(paths.cells, part);
  triangles.clear();
}

FoundConnectors device_connectors(const WallRows& rows, const CriticalSimplices& critical, Offset most_together) {
  Connectors connectors(rows, critical, most_together);
  if (!critical.triangles.empty()) connectors.add(0, static_cast<Id>(critical.triangles.size()));
  return std::move(connectors.found);
}

}  // namespace gale::detail
