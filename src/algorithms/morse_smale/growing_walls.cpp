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
  const auto larger = allocate<InWorkers<T>>(label, std::max(size, 2 * static_cast<Offset>(array.extent(0))));
  const auto part = std::make_pair(Offset(0), used);
  Kokkos::deep_copy(space, Kokkos::subview(larger, part), Kokkos::subview(array, part));
  space.fence();
  array = larger;
}

/// Makes an array begin with these.
template <class T>
void copy_in(const std::vector<T>& from, const InWorkers<T>& to) {
  const Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged> given(from.data(), from.size());
  Kokkos::deep_copy(Kokkos::subview(to, std::make_pair(std::size_t(0), from.size())), given);
}

/// Crosses the edges of one triangle.
struct CrossSides {
  EdgesInMemory gradient;
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
    const std::uint64_t at = sink.table.insert(sink.table.key(wall, gradient.pairs_begin[high] + place), is_new);
    sink.table.put_above(at, from, [this](std::uint32_t a, std::uint32_t b) {
      return gradient.is_less(sink.triangles(a), sink.triangles(b));
    });
    if (!is_new) return;
    atomic_add(&sink.counts(1), Offset(1));
    const Id third = row.third(place);
    if (third != no_id) {
      sink.triangles(atomic_add(&sink.counts(0), Offset(1))) = {high, low, third, wall};
    } else if (gradient.vertex_successor[high] != low) {
      sink.rims(atomic_add(&sink.counts(2), Offset(1))) = {wall, high, low};
    }
  }
};

/// Calls visit(triangle, are_several) with each triangle on the way up from a rim, by its number, and whether there are
/// more where it was taken.
template <class Visit>
KOKKOS_FUNCTION void climb(const EdgesInMemory& gradient, const WallSink& found, Id walls, const WallRim& rim,
                           const Visit& visit) {
  for (Id high = rim.high, low = rim.low;;) {
    const std::uint64_t at =
        found.table.find(found.table.key(rim.wall, gradient.pairs_begin[high] + gradient.row(high).find(low)));
    const std::uint32_t triangle = found.table.least_above(at);
    visit(triangle, found.table.are_several_above(at));
    if (triangle < static_cast<std::uint32_t>(walls)) return;
    high = found.triangles(triangle).high;
    low = found.triangles(triangle).low;
  }
}

}  // namespace

WallTable::WallTable(const WorkerSpace& space, Offset places, int word_bits)
    : edges_(allocate<InWorkers<std::uint64_t>>("GALE::wall_edges", places)),
      above_(allocate<InWorkers<std::uint32_t>>("GALE::triangles_above", places)),
      word_bits_(word_bits) {
  Kokkos::deep_copy(space, edges_, none);
  Kokkos::deep_copy(space, above_, no_triangle);
}

void WallTable::grow(const WorkerSpace& space) {
  const WallTable old = *this, larger(space, 2 * places(), word_bits_);
  parallel_for(
      "GALE::grow_wall_table", space, old.places(), KOKKOS_LAMBDA(Offset i) {
        if (old.edges_(i) == none) return;
        bool is_new;
        larger.above_(larger.insert(old.edges_(i), is_new)) = old.above_(i);
      });
  space.fence();
  *this = larger;
}

GrowingWalls::GrowingWalls(const WorkerSpace& space, const DiscreteGradient& gradient)
    : space_(space),
      gradient_{gradient.store().pair_words().in<WorkerMemory>().data(),
                gradient.store().pairs_begin().in<WorkerMemory>().data(),
                gradient.store().vertex_successors().in<WorkerMemory>().data(),
                gradient.order().keys_in<WorkerMemory>().data(), gradient.mesh().vertex_input<WorkerMemory>().data()},
      word_bits_(bits_for(static_cast<Offset>(gradient.store().pair_words().size()))) {
  found_.counts = allocate<InWorkers<Offset>>("GALE::wall_counts", 3);
}

Id GrowingWalls::most_walls() const {
  return static_cast<Id>(std::min(Offset(1) << std::min(63 - word_bits_, 30), WallTable::most_triangles));
}

void GrowingWalls::grow(const TriangleVertices* critical, Id count, Offset most_triangles) {
  begin(critical, count);
  for (Offset first = 0; first < triangles_;) {
    const Offset layer = triangles_ - first;
    reserve(layer, most_triangles);
    cross(first, first + layer);
    read_counts();
    first += layer;
  }
}

void GrowingWalls::begin(const TriangleVertices* critical, Id count) {
  walls_ = count;
  triangles_ = count;
  edges_ = rims_ = 0;
  constexpr Offset least = 4096;
  found_.triangles = allocate<InWorkers<WallTriangle>>("GALE::wall_triangles", std::max(4 * triangles_, least));
  found_.rims = allocate<InWorkers<WallRim>>("GALE::wall_rims", std::max(4 * triangles_, least));
  found_.table = WallTable(space_, Offset(1) << bits_for(std::max(8 * triangles_, least)), word_bits_);
  std::vector<WallTriangle> roots;
  for (Id i = 0; i < count; ++i) roots.push_back({critical[i][0], critical[i][1], critical[i][2], i});
  copy_in(roots, found_.triangles);
  copy_in(std::vector<Offset>{triangles_, edges_, rims_}, found_.counts);
}

/// Room for all that a layer of triangles can add.
void GrowingWalls::reserve(Offset layer, Offset most_triangles) {
  const Offset more = 3 * layer;
  if (triangles_ + more > WallTable::most_triangles || triangles_ > most_triangles)
    throw OutOfMemory("walls of more than " + std::to_string(most_triangles) + " triangles");
  make_room(space_, "GALE::wall_triangles", found_.triangles, triangles_, triangles_ + more);
  make_room(space_, "GALE::wall_rims", found_.rims, rims_, rims_ + more);
  while (10 * (edges_ + more) > 7 * found_.table.places()) found_.table.grow(space_);
}

void GrowingWalls::cross(Offset begin, Offset end) {
  Kokkos::parallel_for("GALE::grow_walls",
                       Kokkos::RangePolicy<WorkerSpace, Kokkos::IndexType<Offset>>(space_, begin, end),
                       CrossSides{gradient_, found_, walls_});
}

void GrowingWalls::read_counts() {
  Offset counts[3];
  const Kokkos::View<Offset*, HostMemory, Kokkos::MemoryUnmanaged> here(counts, 3);
  Kokkos::deep_copy(space_, here, found_.counts);
  space_.fence();
  triangles_ = counts[0];
  edges_ = counts[1];
  rims_ = counts[2];
}

std::vector<WallRim> GrowingWalls::rims() const {
  const auto there = on_host(Kokkos::subview(found_.rims, std::make_pair(Offset(0), rims_)));
  return {there.data(), there.data() + rims_};
}

void GrowingWalls::append_paths(const std::vector<WallRim>& from, Separatrices<TriangleVertices>& paths) const {
  const Offset count = static_cast<Offset>(from.size());
  const Kokkos::View<const WallRim*, HostMemory, Kokkos::MemoryUnmanaged> given(from.data(), from.size());
  const auto rims = in_memory<WorkerMemory>(given);
  const auto begin = allocate<InWorkers<Offset>>("GALE::connector_begin", count + 1);
  const auto is_only = allocate<InWorkers<std::uint8_t>>("GALE::connector_is_only", count);
  const EdgesInMemory gradient = gradient_;
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
