#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale/growing_walls.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class T>
using Given = Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>;

WallTable grown(const WorkerSpace& space, const WallTable& table, int edge_bits) {
  const WallTable larger(space, 2 * table.places(), edge_bits);
  parallel_for(
      "GALE::grow_wall_table", space, table.places(), KOKKOS_LAMBDA(Offset i) { table.copy_to(larger, i); });
  space.fence();
  return larger;
}

/// Crosses the sides of `count` triangles.
void cross_layer(const WorkerSpace& space, Offset first, Offset count, const CrossSides& sides) {
  parallel_for(
      "GALE::grow_walls", space, count, KOKKOS_LAMBDA(Offset i) { sides(first + i); });
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
void append_paths(const WorkerSpace& space, const CrossSides& walls, const std::vector<WallRim>& from,
                  Separatrices<TriangleVertices>& paths) {
  const Offset count = static_cast<Offset>(from.size());
  const auto rims = in_memory<WorkerMemory>(Given<WallRim>(from.data(), from.size()));
  const auto begin = allocate<InWorkers<Offset>>("GALE::connector_begin", count + 1);
  const auto is_only = allocate<InWorkers<std::uint8_t>>("GALE::connector_is_only", count);
  parallel_for(
      "GALE::connector_lengths", space, count, KOKKOS_LAMBDA(Offset i) {
        Offset length = 0;
        bool only = true;
        climb(walls, rims(i), [&](std::uint32_t, bool are_several) {
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
        climb(walls, rims(i), [&](std::uint32_t number, bool) {
          const WallTriangle& triangle = walls.sink.triangles(number);
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

/// Finds connectors in the descending walls of critical triangles, of which some grow side by side: a layer of
/// triangles at a time, each across the edges that it isn't paired with. So there are as many launches as the deepest
/// wall has layers; time and memory grow with all walls together.
class Connectors {
 public:
  Connectors(const WallRows& rows, const std::vector<TriangleVertices>& critical, const CriticalPlaces& places,
             Offset most_together)
      : critical_(critical),
        places_(places),
        most_together_(most_together),
        edge_bits_(bits_for(rows.edges())),
        walls_{rows, {}, 0} {
    found_.counts = allocate<InWorkers<WallCounts>>("GALE::wall_counts", 1);
  }

  /// Appends those of some critical triangles: in halves, if their walls together are too many.
  void add(Id begin, Id end) {
    const Id size = end - begin;
    if (size <= Offset(1) << std::min(63 - edge_bits_, 30)) {  // walls that keys can number
      try {
        grow(begin, size, size > 1 ? most_together_ : WallTable::most_triangles);
        add_paths(begin);
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
  void grow(Id first_wall, Id count, Offset most_triangles) {
    begin(critical_.data() + first_wall, count);
    for (Offset first = 0; first < counts_.triangles;) {
      const Offset layer = counts_.triangles - first;
      reserve(layer, most_triangles);
      cross_layer(space_, first, layer, walls_);
      Kokkos::deep_copy(space_, Kokkos::View<WallCounts*, HostMemory, Kokkos::MemoryUnmanaged>(&counts_, 1),
                        found_.counts);
      space_.fence();
      first += layer;
    }
  }

  void begin(const TriangleVertices* critical, Id count) {
    walls_.walls = count;
    counts_ = {count, 0, 0};
    found_.triangles = {};  // of other walls
    found_.rims = {};
    found_.table = {};
    constexpr Offset least = 4096;
    found_.triangles = allocate<InWorkers<WallTriangle>>("GALE::wall_triangles", std::max(4 * Offset(count), least));
    found_.rims = allocate<InWorkers<WallRim>>("GALE::wall_rims", std::max(4 * Offset(count), least));
    found_.table = WallTable(space_, Offset(1) << bits_for(std::max(8 * Offset(count), least)), edge_bits_);
    std::vector<WallTriangle> roots;
    for (Id i = 0; i < count; ++i) roots.push_back({critical[i][0], critical[i][1], critical[i][2], i});
    Kokkos::deep_copy(first_of(found_.triangles, roots.size()), Given<WallTriangle>(roots.data(), roots.size()));
    Kokkos::deep_copy(found_.counts, Given<WallCounts>(&counts_, 1));
  }

  /// Room for all that a layer of triangles can add.
  void reserve(Offset layer, Offset most_triangles) {
    const Offset more = 3 * layer, most = std::min(most_triangles, WallTable::most_triangles - more);
    if (counts_.triangles > most) throw OutOfMemory("walls of more than " + std::to_string(most) + " triangles");
    make_room(space_, "GALE::wall_triangles", found_.triangles, counts_.triangles, counts_.triangles + more);
    make_room(space_, "GALE::wall_rims", found_.rims, counts_.rims, counts_.rims + more);
    while (10 * (counts_.edges + more) > 7 * found_.table.places())
      found_.table = grown(space_, found_.table, edge_bits_);
  }

  /// The rims come in no order: sorts them by wall and edge.
  void add_paths(Id first) {
    const auto there = on_host(first_of(found_.rims, counts_.rims));
    std::vector<std::pair<Id, WallRim>> rims;
    for (Offset i = 0; i < counts_.rims; ++i) rims.push_back({places_.of_edge(there(i).high, there(i).low), there(i)});
    std::sort(rims.begin(), rims.end(), [](const auto& a, const auto& b) {
      return std::make_pair(a.second.wall, a.first) < std::make_pair(b.second.wall, b.first);
    });
    std::vector<WallRim> sorted;
    for (const auto& [place, rim] : rims) sorted.push_back(rim);
    append_paths(space_, walls_, sorted, paths);
    for (const auto& [place, rim] : rims) {
      paths.sources.push_back(place);
      paths.destinations.push_back(first + rim.wall);
    }
  }

  const WorkerSpace space_{};
  const std::vector<TriangleVertices>& critical_;
  const CriticalPlaces& places_;
  const Offset most_together_;
  const int edge_bits_;
  CrossSides walls_;
  WallSink& found_ = walls_.sink;
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
