#include <algorithm>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/growing_walls.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

template <class T>
using InWorkers = Array<T, WorkerMemory>;

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
  const auto part = std::make_pair(Offset(0), used);
  Kokkos::deep_copy(space, Kokkos::subview(larger, part), Kokkos::subview(array, part));
  space.fence();
  array = larger;
}

/// Makes an array begin with these.
template <class T>
void copy_in(const std::vector<T>& from, const InWorkers<T>& to) {
  const Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged> given(from.data(), from.size());
  Kokkos::deep_copy(first_of(to, from.size()), given);
}

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

/// Crosses those of `count` triangles.
void cross_layer(const WorkerSpace& space, Offset first, Offset count, const CrossSides& sides) {
  parallel_for(
      "GALE::grow_walls", space, count, KOKKOS_LAMBDA(Offset i) { sides(first + i); });
}

/// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there are
/// more where it was taken.
template <class Visit>
KOKKOS_FUNCTION void climb(const GradientRows& gradient, const WallSink& found, Id walls, const WallRim& rim,
                           const Visit& visit) {
  for (Id high = rim.high, low = rim.low;;) {
    const std::uint64_t at =
        found.table.find(found.table.key(rim.wall, gradient.number(high, gradient.row(high).find(low))));
    const std::uint32_t triangle = found.table.least_above(at);
    visit(triangle, found.table.are_several_above(at));
    if (triangle < static_cast<std::uint32_t>(walls)) return;
    high = found.triangles(triangle).high;
    low = found.triangles(triangle).low;
  }
}

}  // namespace

GrowingWalls::GrowingWalls(const WorkerSpace& space, const DiscreteGradient& gradient)
    : space_(space),
      gradient_{gradient.store().pair_words().in<WorkerMemory>().data(),
                gradient.store().pairs_begin().in<WorkerMemory>().data(),
                gradient.store().vertex_successors().in<WorkerMemory>().data(),
                gradient.order().keys_in<WorkerMemory>().data(), gradient.mesh().vertex_input<WorkerMemory>().data()},
      edge_bits_(bits_for(static_cast<Offset>(gradient.store().pair_words().size()))) {
  found_.counts = allocate<InWorkers<WallCounts>>("GALE::wall_counts", 1);
}

Id GrowingWalls::most_walls() const { return static_cast<Id>(Offset(1) << std::min(63 - edge_bits_, 30)); }

void GrowingWalls::grow(const TriangleVertices* critical, Id count, Offset most_triangles) {
  begin(critical, count);
  for (Offset first = 0; first < counts_.triangles;) {
    const Offset layer = counts_.triangles - first;
    reserve(layer, most_triangles);
    cross_layer(space_, first, layer, CrossSides{gradient_, found_, walls_});
    read_counts();
    first += layer;
  }
}

void GrowingWalls::begin(const TriangleVertices* critical, Id count) {
  walls_ = count;
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
  copy_in(roots, found_.triangles);
  copy_in(std::vector<WallCounts>{counts_}, found_.counts);
}

/// Room for all that a layer of triangles can add.
void GrowingWalls::reserve(Offset layer, Offset most_triangles) {
  const Offset more = 3 * layer, most = std::min(most_triangles, WallTable::most_triangles - more);
  if (counts_.triangles > most) throw OutOfMemory("walls of more than " + std::to_string(most) + " triangles");
  make_room(space_, "GALE::wall_triangles", found_.triangles, counts_.triangles, counts_.triangles + more);
  make_room(space_, "GALE::wall_rims", found_.rims, counts_.rims, counts_.rims + more);
  while (10 * (counts_.edges + more) > 7 * found_.table.places()) found_.table.grow(space_);
}

void GrowingWalls::read_counts() {
  const Kokkos::View<WallCounts*, HostMemory, Kokkos::MemoryUnmanaged> here(&counts_, 1);
  Kokkos::deep_copy(space_, here, found_.counts);
  space_.fence();
}

std::vector<WallRim> GrowingWalls::rims() const {
  const auto there = on_host(Kokkos::subview(found_.rims, std::make_pair(Offset(0), counts_.rims)));
  return {there.data(), there.data() + counts_.rims};
}

void GrowingWalls::append_paths(const std::vector<WallRim>& from, Separatrices<TriangleVertices>& paths) const {
  const Offset count = static_cast<Offset>(from.size());
  const Kokkos::View<const WallRim*, HostMemory, Kokkos::MemoryUnmanaged> given(from.data(), from.size());
  const auto rims = in_memory<WorkerMemory>(given);
  const auto begin = allocate<InWorkers<Offset>>("GALE::connector_begin", count + 1);
  const auto is_only = allocate<InWorkers<std::uint8_t>>("GALE::connector_is_only", count);
  const GradientRows gradient = gradient_;
  const WallSink found = found_;
  const Id walls = walls_;
  parallel_for(
      "GALE::connector_lengths", space_, count, KOKKOS_LAMBDA(Offset i) {
        Offset length = 0;
        bool only = true;
        climb(gradient, found, walls, rims(i), [&](std::uint32_t, bool are_several) {
          ++length;
          only &= !are_several;
        });
        begin(i) = length;
        is_only(i) = only;
      });
  const Offset total = exclusive_scan(
      "GALE::connector_begins", space_, count, begin, KOKKOS_LAMBDA(Offset i) { return begin(i); });
  const auto cells = allocate<InWorkers<TriangleVertices>>("GALE::connector_cells", total);
  parallel_for(
      "GALE::follow_connectors", space_, count, KOKKOS_LAMBDA(Offset i) {
        Offset at = begin(i);
        climb(gradient, found, walls, rims(i), [&](std::uint32_t number, bool) {
          const WallTriangle& triangle = found.triangles(number);
          cells(at++) = {triangle.high, triangle.low, triangle.third};
        });
      });
  space_.fence();
  const auto begin_here = on_host(begin);
  const auto only_here = on_host(is_only);
  const auto cells_here = on_host(cells);
  const Offset before = paths.begin.back();
  for (Offset i = 0; i < count; ++i) paths.begin.push_back(before + begin_here(i + 1));
  paths.is_only.insert(paths.is_only.end(), only_here.data(), only_here.data() + count);
  paths.cells.insert(paths.cells.end(), cells_here.data(), cells_here.data() + total);
}

}  // namespace gale::detail
