#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/morse_smale/wall_table.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class T>
using InWorkers = Array<T, WorkerMemory>;

template <class T>
using Given = Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>;

/// A triangle of a wall; (high, low) is the edge that it is paired with, unless it is the critical one.
struct WallTriangle {
  Id high, low, third;
  Id wall;
};

/// A critical edge that a wall ends at.
struct WallRim {
  Id wall;
  Id high, low;
};

/// What kernels read of a discrete gradient that kernels found, to follow walls through it.
struct GradientRows {
  const Id* pair_words;
  const Offset* pairs_begin;
  const Id* vertex_successor;
  const std::uint64_t* keys;
  const Id* vertex_input;

  explicit GradientRows(const DiscreteGradient& gradient)
      : pair_words(gradient.store().pair_words().in<WorkerMemory>().data()),
        pairs_begin(gradient.store().pairs_begin().in<WorkerMemory>().data()),
        vertex_successor(gradient.store().vertex_successors().in<WorkerMemory>().data()),
        keys(gradient.order().keys_in<WorkerMemory>().data()),
        vertex_input(gradient.mesh().vertex_input<WorkerMemory>().data()) {}

  /// The number of an edge among all edges: the place of its word.
  KOKKOS_FUNCTION Offset number(Id high, Id place) const { return pairs_begin[high] + 1 + place; }

  KOKKOS_FUNCTION EdgePairRow row(Id high) const {
    return EdgePairRow(const_cast<Id*>(pair_words) + pairs_begin[high]);  // which it only reads
  }

  /// Is one triangle before another, both written with their input vertices ascending?
  KOKKOS_FUNCTION bool is_less(const WallTriangle& a, const WallTriangle& b) const {
    Id first[3], second[3];
    write(a, first);
    write(b, second);
    for (int i = 0; i < 2; ++i) {
      if (first[i] != second[i]) return first[i] < second[i];
    }
    return first[2] < second[2];
  }

 private:
  KOKKOS_FUNCTION void write(const WallTriangle& triangle, Id (&written)[3]) const {
    const Id ids[] = {vertex_input[triangle.high], vertex_input[triangle.low], vertex_input[triangle.third]};
    for (int i = 0; i < 3; ++i) written[(ids[0] < ids[i]) + (ids[1] < ids[i]) + (ids[2] < ids[i])] = ids[i];
  }
};

/// How many a kernel has found so far.
struct WallCounts {
  Offset triangles = 0, edges = 0, rims = 0;
};

/// Where the kernels that make walls grow put what they find. Copies share it.
struct WallSink {
  WallTable table;
  InWorkers<WallTriangle> triangles;  ///< the critical ones first
  InWorkers<WallRim> rims;
  InWorkers<WallCounts> counts;  ///< one
};

/// Crosses the edges of one triangle.
struct CrossSides {
  GradientRows gradient;
  WallSink sink;
  Id walls;

  KOKKOS_FUNCTION void operator()(Offset triangle) const {
    const auto number = static_cast<std::uint32_t>(triangle);
    const WallTriangle from = sink.triangles(triangle);
    if (triangle < walls) cross(from.high, from.low, from.wall, number);
    cross(from.high, from.third, from.wall, number);
    const bool in_order = gradient.keys[from.low] > gradient.keys[from.third];
    cross(in_order ? from.low : from.third, in_order ? from.third : from.low, from.wall, number);
  }

 private:
  KOKKOS_FUNCTION void cross(Id high, Id low, Id wall, std::uint32_t from) const {
    const EdgePairRow row = gradient.row(high);
    const Id place = row.find(low);
    bool is_new = false;
    const std::uint64_t at = sink.table.insert(sink.table.key(wall, gradient.number(high, place)), is_new);
    sink.table.put_above(at, from, [this](std::uint32_t a, std::uint32_t b) {
      return gradient.is_less(sink.triangles(a), sink.triangles(b));
    });
    if (!is_new) return;
    atomic_add(&sink.counts(0).edges, Offset(1));
    const Id third = row.third(place);
    if (third != no_id) {
      sink.triangles(atomic_add(&sink.counts(0).triangles, Offset(1))) = {high, low, third, wall};
    } else if (gradient.vertex_successor[high] != low) {
      sink.rims(atomic_add(&sink.counts(0).rims, Offset(1))) = {wall, high, low};
    }
  }
};

/// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there are
/// more where it was taken.
template <class Visit>
KOKKOS_FUNCTION void climb(const CrossSides& walls, const WallRim& rim, const Visit& visit) {
  const GradientRows& gradient = walls.gradient;
  const WallTable& table = walls.sink.table;
  for (Id high = rim.high, low = rim.low;;) {
    const std::uint64_t at = table.find(table.key(rim.wall, gradient.number(high, gradient.row(high).find(low))));
    const std::uint32_t triangle = table.least_above(at);
    visit(triangle, table.are_several_above(at));
    if (triangle < static_cast<std::uint32_t>(walls.walls)) return;
    high = walls.sink.triangles(triangle).high;
    low = walls.sink.triangles(triangle).low;
  }
}

/// Bits that numbers below `count` take.
int bits_for(Offset count) {
  int bits = 1;
  while ((Offset(1) << bits) < count) ++bits;
  return bits;
}

/// Room for at least so many, and what there was.
template <class T>
void make_room(const WorkerSpace& space, const char* label, InWorkers<T>& array, Offset used, Offset size) {
  if (size <= static_cast<Offset>(array.extent(0))) return;
  const auto larger = [&] {
    try {
      return allocate<InWorkers<T>>(label, std::max(size, 2 * static_cast<Offset>(array.extent(0))));
    } catch (const OutOfMemory&) {
      return allocate<InWorkers<T>>(label, size);
    }
  }();
  Kokkos::deep_copy(space, first_of(larger, used), first_of(array, used));
  space.fence();
  array = larger;
}

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
  const Offset total = exclusive_scan(
      "GALE::connector_begins", space, count, begin, KOKKOS_LAMBDA(Offset i) { return begin(i); });
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
  const auto only_here = on_host(is_only);
  const auto cells_here = on_host(cells);
  const Offset before = paths.begin.back();
  for (Offset i = 0; i < count; ++i) paths.begin.push_back(before + begin_here(i + 1));
  paths.is_only.insert(paths.is_only.end(), only_here.data(), only_here.data() + count);
  paths.cells.insert(paths.cells.end(), cells_here.data(), cells_here.data() + total);
}

/// Finds connectors in the descending walls of critical triangles, of which some grow side by side: a layer of
/// triangles at a time, each across the edges that it isn't paired with. So there are as many launches as the deepest
/// wall has layers; time and memory grow with all walls together.
class Connectors {
 public:
  Connectors(const DiscreteGradient& gradient, const CriticalSimplices& critical, const CriticalPlaces& places,
             Offset most_together)
      : critical_(critical),
        places_(places),
        most_together_(most_together),
        edge_bits_(bits_for(static_cast<Offset>(gradient.store().pair_words().size()))),
        walls_{GradientRows(gradient), {}, 0} {
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
    begin(critical_.triangles.data() + first_wall, count);
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
  const CriticalSimplices& critical_;
  const CriticalPlaces& places_;
  const Offset most_together_;
  const int edge_bits_;
  CrossSides walls_;
  WallSink& found_ = walls_.sink;
  WallCounts counts_;
};

}  // namespace

Separatrices<TriangleVertices> device_connectors(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                                 const CriticalPlaces& places, Offset most_together) {
  Connectors connectors(gradient, critical, places, most_together);
  const Id count = static_cast<Id>(critical.triangles.size());
  if (count > 0) connectors.add(0, count);
  return std::move(connectors.paths);
}

}  // namespace gale::detail
