#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale/growing_walls.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class T>
using Given = Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>;

/// Puts critical triangles at the beginning, with open sides.
void begin_walls(const WorkerSpace& space, Id count, const InWorkers<const Id>& vertices, const WallSink& sink) {
  parallel_for(
      "GALE::begin_walls", space, count, KOKKOS_LAMBDA(Offset i) {
        sink.triangles(i) = {vertices(3 * i), vertices(3 * i + 1), vertices(3 * i + 2), static_cast<Id>(i)};
        sink.open(i) = static_cast<std::uint32_t>(i);
      });
}

/// Says which edges triangles are above.
void put_above(const WorkerSpace& space, Offset triangles, const GrownWalls& walls) {
  parallel_for(
      "GALE::put_above", space, triangles, KOKKOS_LAMBDA(Offset i) { walls.put_above(i); });
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

/// Appends the path from each of these rims up to the wall's critical triangle, which it includes. Sources and
/// destinations are the caller's.
void append_paths(const WorkerSpace& space, const GrownWalls& walls, const std::vector<WallRim>& from,
                  Separatrices<TriangleVertices>& paths) {
  const Offset count = static_cast<Offset>(from.size());
  const auto rims = in_memory<WorkerMemory>(Given<WallRim>(from.data(), from.size()));
  const auto begin = allocate<InWorkers<Offset>>("GALE::connector_begin", count + 1);
  const auto is_only = allocate<InWorkers<std::uint8_t>>("GALE::connector_is_only", count);
  parallel_for(
      "GALE::connector_lengths", space, count, KOKKOS_LAMBDA(Offset i) {
        Offset length = 0;
        bool only = true;
        walls.climb(rims(i), [&](std::uint32_t, bool are_several) {
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
        walls.climb(rims(i), [&](std::uint32_t number, bool) {
          const WallTriangle& triangle = walls.triangles(number);
          cells(at++) = {triangle.high, triangle.low, triangle.third};
        });
      });
  space.fence();
  const auto begin_here = on_host(begin);
  const Offset before = paths.begin.back();
  for (Offset i = 0; i < count; ++i) paths.begin.push_back(before + begin_here(i + 1));
  append(paths.is_only, is_only);
  append(paths.cells, cells);
}

/// Finds connectors in the descending walls of critical triangles, of which some grow side by side. Time and memory
/// grow with all walls together.
class Connectors {
 public:
  Connectors(const WallRows& rows, const std::vector<TriangleVertices>& critical, const CriticalPlaces& places,
             Offset most_together)
      : critical_(critical), places_(places), most_together_(most_together), rows_(rows) {
    found_.keys.bits = bits_for(rows.edges());
    found_.counts = allocate<InWorkers<WallCounts>>("GALE::wall_counts", 1);
  }

  /// Appends those of some critical triangles: in halves, if their walls together are too many.
  void add(Id begin, Id end) {
    const Id size = end - begin;
    if (size <= Offset(1) << std::min(63 - found_.keys.bits, 30)) {  // walls that keys can number
      try {
        add_paths(begin, grow(begin, size, size > 1 ? most_together_ : WallTable::most_triangles));
        return;
      } catch (const OutOfMemory&) {
        if (size == 1) throw;
      }
    }
    add(begin, begin + size / 2);
    add(begin + size / 2, end);
  }

  Separatrices<TriangleVertices> paths;

 private:
  GrownWalls grow(Id first_wall, Id count, Offset most_triangles) {
    begin(critical_.data() + first_wall, count);
    for (Offset first = 0; first < counts_.open;) {
      stop_if_asked();
      const Offset open = counts_.open - first;
      reserve(GrowWalls::most_sides * open, most_triangles);
      parallel_for("GALE::grow_walls", space_, open, GrowWalls{rows_, found_, count, first, open, most_triangles});
      Kokkos::deep_copy(space_, Kokkos::View<WallCounts*, HostMemory, Kokkos::MemoryUnmanaged>(&counts_, 1),
                        found_.counts);
      space_.fence();
      first += open;
    }
    const GrownWalls grown{rows_, found_.triangles, count, WallTable(space_, found_.edges, found_.keys)};
    put_above(space_, counts_.triangles, grown);
    return grown;
  }

  void begin(const TriangleVertices* critical, Id count) {
    found_.triangles = {};  // of other walls
    found_.rims = {};
    found_.open = {};
    found_.edges = {};
    counts_ = {count, 0, count};
    const Offset room = std::max(16 * Offset(count), Offset(1) << 16);
    found_.triangles = allocate<InWorkers<WallTriangle>>("GALE::wall_triangles", room);
    found_.rims = allocate<InWorkers<WallRim>>("GALE::wall_rims", room);
    found_.open = allocate<InWorkers<std::uint32_t>>("GALE::open_triangles", room);
    found_.edges = KeyTable(space_, Offset(1) << bits_for(2 * room));
    Kokkos::deep_copy(found_.counts, Given<WallCounts>(&counts_, 1));
    const auto vertices = in_memory<WorkerMemory>(Given<Id>(critical->data(), 3 * static_cast<std::size_t>(count)));
    begin_walls(space_, count, vertices, found_);
    space_.fence();
  }

  /// Makes room for what a launch adds at least: one step of each thread. Throws OutOfMemory.
  void reserve(Offset more, Offset most_triangles) {
    const Offset most = std::min(most_triangles, WallTable::most_triangles - more);
    if (counts_.triangles > most) throw OutOfMemory("walls of more than " + std::to_string(most) + " triangles");
    make_room(space_, "GALE::wall_triangles", found_.triangles, counts_.triangles, counts_.triangles + more);
    make_room(space_, "GALE::wall_rims", found_.rims, counts_.rims, counts_.rims + more);
    make_room(space_, "GALE::open_triangles", found_.open, counts_.open, counts_.open + more);
    make_room(space_, found_.edges, counts_.triangles + counts_.rims + more);
  }

  /// Sorts the rims, which come in no order, by wall and edge. Appends nothing if it throws OutOfMemory.
  void add_paths(Id first, const GrownWalls& walls) {
    const auto there = on_host(first_of(found_.rims, counts_.rims));
    using Keyed = std::pair<std::pair<Id, Id>, WallRim>;
    auto rims = unwritten<Keyed>(counts_.rims);
    parallel_for("GALE::rims", HostExecutionSpace(), counts_.rims, [&](Offset i) {
      const WallRim& rim = there(i);
      rims[i] = {{rim.wall, places_.of_edge(rim.high, rim.low)}, rim};
    });
    parallel_sort("GALE::sort_rims", rims.begin(), rims.end(),
                  [](const Keyed& a, const Keyed& b) { return a.first < b.first; });
    std::vector<WallRim> sorted;
    for (const auto& [key, rim] : rims) sorted.push_back(rim);
    append_paths(space_, walls, sorted, paths);
    for (const auto& [key, rim] : rims) {
      paths.sources.push_back(key.second);
      paths.destinations.push_back(first + key.first);
    }
  }

  const WorkerSpace space_{};
  const std::vector<TriangleVertices>& critical_;
  const CriticalPlaces& places_;
  const Offset most_together_;
  const WallRows rows_;
  WallSink found_;
  WallCounts counts_;
};

}  // namespace

Separatrices<TriangleVertices> device_connectors(const WallRows& rows, const std::vector<TriangleVertices>& critical,
                                                 const CriticalPlaces& places, Offset most_together) {
  Connectors connectors(rows, critical, places, most_together);
  if (!critical.empty()) connectors.add(0, static_cast<Id>(critical.size()));
  return std::move(connectors.paths);
}

}  // namespace gale::detail
