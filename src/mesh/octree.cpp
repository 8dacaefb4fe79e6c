#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/octree.hpp>

namespace gale::detail {

namespace {

/// Two zero bits between any two of the lowest 21.
KOKKOS_FUNCTION std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

template <class Memory>
using Codes = Array<std::uint64_t, Memory>;

/// The octree cell that holds the codes of equal `code >> shift`, looked at around the sorted position `at`, which it
/// holds. It is searched no further than `capacity` positions away.
template <class Memory>
struct CellWindow {
  const Codes<Memory>& codes;
  int shift;
  Id at;
  Id capacity;

  KOKKOS_FUNCTION bool inside(Id i) const { return (codes(i) >> shift) == (codes(at) >> shift); }

  KOKKOS_FUNCTION Id begin() const {
    return bisect(at > capacity ? at - capacity : 0, at, [this](Id i) { return !inside(i); });
  }

  /// Does the cell go as far as half of that, to either side? One that holds more does: others are told by two
  /// readings.
  KOKKOS_FUNCTION bool may_overflow() const {
    const Id below = capacity / 2, above = capacity - below;
    return (at >= below && inside(at - below)) ||
           (static_cast<Offset>(at) + above < static_cast<Offset>(codes.extent(0)) && inside(at + above));
  }

  /// Does the cell hold more than `capacity` codes? If `first` is where it begins, as `begin()` says.
  KOKKOS_FUNCTION bool overflows(Id first) const {
    return static_cast<Offset>(first) + capacity < static_cast<Offset>(codes.extent(0)) && inside(first + capacity);
  }
};

/// Levels of the octree at which two codes lie in the same cell.
KOKKOS_FUNCTION int common_levels(std::uint64_t a, std::uint64_t b) {
  return a == b ? morton_levels : morton_levels - 1 - highest_bit(a ^ b) / 3;
}

template <class Memory>
KOKKOS_FUNCTION Id run_begin(const Codes<Memory>& codes, Id at) {
  return bisect(Id(0), at, [&](Id i) { return codes(i) != codes(at); });
}

/// A leaf begins where the smallest cell that holds both a code and its predecessor has more than `capacity` codes.
template <class Memory>
KOKKOS_FUNCTION bool begins_leaf(const Codes<Memory>& codes, Id at, Id capacity) {
  if (at == 0) return true;
  if (codes(at - 1) == codes(at)) {
    if (at < capacity || codes(at - capacity) != codes(at)) return false;
    return (at - run_begin(codes, at)) % capacity == 0;
  }
  const int levels = common_levels(codes(at - 1), codes(at));
  const CellWindow<Memory> cell{codes, 3 * (morton_levels - levels), at, capacity};
  return cell.may_overflow() && cell.overflows(cell.begin());
}

/// Where the leaf ends that begins at `begin`: the largest cell that holds no code before it and at most `capacity`
/// from it on.
template <class Memory>
KOKKOS_FUNCTION Id leaf_end(const Codes<Memory>& codes, Id begin, Id capacity) {
  const auto count = static_cast<Id>(codes.extent(0));
  const Id last = count - begin > capacity ? begin + capacity : count;
  const int before = begin > 0 ? common_levels(codes(begin - 1), codes(begin)) + 1 : 0;
  const int behind = last < count ? common_levels(codes(begin), codes(last)) + 1 : 0;
  const int levels = before > behind ? before : behind;
  const int shift = levels < morton_levels ? 3 * (morton_levels - levels) : 0;
  return bisect(begin, last, [&](Id i) { return (codes(i) >> shift) == (codes(begin) >> shift); });
}

/// Goes from leaf to leaf.
std::vector<Id> leaves_on_host(const Codes<HostMemory>& codes, Id capacity) {
  return concatenated(of_parts("GALE::octree_leaves", codes.extent(0), [&](Offset first, Offset last) {
    std::vector<Id> mine;
    Id at = static_cast<Id>(first);
    while (at < last && !begins_leaf(codes, at, capacity)) ++at;
    for (; at < last; at = leaf_end(codes, at, capacity)) {
      stop_if_asked_at(static_cast<Offset>(mine.size()));
      mine.push_back(at);
    }
    return mine;
  }));
}

/// A box around nothing.
KOKKOS_FUNCTION Box empty_box() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

/// Makes a box hold another one. What isn't a number becomes its lower end, and stays it.
KOKKOS_FUNCTION void extend(Box& box, const double (&low)[3], const double (&high)[3]) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = low[axis] < box.low[axis] || low[axis] != low[axis] ? low[axis] : box.low[axis];
    box.high[axis] = high[axis] > box.high[axis] ? high[axis] : box.high[axis];
  }
}

/// Reads the points once. Its ends are finite if all points are.
template <class Coordinate>
Box box_on_host(const Points<Coordinate, HostMemory>& points) {
  const auto boxes = of_parts("GALE::bounding_box", points.extent(0), [&](Offset first, Offset last) {
    Box box = empty_box();
    for_range(first, last, [&](Offset i) {
      const double point[3] = {points(i, 0), points(i, 1), points(i, 2)};
      extend(box, point, point);
    });
    return box;
  });
  Box all = empty_box();
  for (const Box& box : boxes) extend(all, box.low, box.high);
  return all;
}

/// Reads the points once, too.
template <class Coordinate>
struct BoxOfPoints {
  using value_type = Box;

  Points<Coordinate, WorkerMemory> points;

  KOKKOS_FUNCTION void init(Box& box) const { box = empty_box(); }
  KOKKOS_FUNCTION void join(Box& box, const Box& other) const { extend(box, other.low, other.high); }
  KOKKOS_FUNCTION void operator()(Offset i, Box& box) const {
    const double point[3] = {points(i, 0), points(i, 1), points(i, 2)};
    extend(box, point, point);
  }
};

template <class Coordinate>
Box box_on_device(const WorkerSpace& space, const Points<Coordinate, WorkerMemory>& points) {
  Box box = empty_box();
  Kokkos::parallel_reduce("GALE::bounding_box", device_range(space, points.extent(0)), BoxOfPoints<Coordinate>{points},
                          box);
  return box;
}

bool is_finite(const Box& box) {
  return std::all_of(box.low, box.low + 3, [](double x) { return std::isfinite(x); }) &&
         std::all_of(box.high, box.high + 3, [](double x) { return std::isfinite(x); });
}

}  // namespace

template <class Coordinate, class Space>
void require_finite(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points) {
  const Offset count = points.extent(0);
  const Offset bad = reduce_min(
      "GALE::finite_points", space, count, count, KOKKOS_LAMBDA(Offset i) {
        const double x = points(i, 0), y = points(i, 1), z = points(i, 2);
        return (x - x) + (y - y) + (z - z) == 0 ? count : i;
      });
  if (bad < count) throw Error("point " + std::to_string(bad) + " has a coordinate that is not finite");
}

template <class Coordinate, class Space>
Box bounding_box(const Space& space, const Points<Coordinate, MemoryOf<Space>>& points) {
  const Box box = [&] {
    if constexpr (is_device<Space>) {
      return box_on_device<Coordinate>(space, points);
    } else {
      return box_on_host<Coordinate>(points);
    }
  }();
  if (!is_finite(box)) require_finite<Coordinate>(space, points);
  return box;
}

Cube cube_around(const Box& box) {
  Cube cube{};
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    cube.origin[axis] = box.low[axis];
    extent = std::max(extent, box.high[axis] - box.low[axis]);
  }
  int exponent = 0;
  std::frexp(extent, &exponent);  // extent < 2^exponent
  cube.cells_per_unit = extent > 0 ? std::ldexp(1.0, morton_levels - exponent) : 0.0;
  return cube;
}

template <class Coordinate, class Space>
Array<std::uint64_t, MemoryOf<Space>> morton_codes(const Space& space,
                                                   const Points<Coordinate, MemoryOf<Space>>& points,
                                                   const Cube& cube) {
  const auto codes = allocate<Array<std::uint64_t, MemoryOf<Space>>>("GALE::morton_codes", points.extent(0));
  parallel_for(
      "GALE::morton_codes", space, points.extent(0), KOKKOS_LAMBDA(Offset i) {
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
          constexpr double last = (1 << morton_levels) - 1;
          const double cell = (double(points(i, axis)) - cube.origin[axis]) * cube.cells_per_unit;
          code |= spread_bits(static_cast<std::uint64_t>(static_cast<std::int32_t>(cell < last ? cell : last)))
                  << (2 - axis);
        }
        codes(i) = code;
      });
  return codes;
}

template <class Space>
std::vector<Id> octree_leaves(const Space& space, const Array<std::uint64_t, MemoryOf<Space>>& codes, int capacity) {
  if constexpr (!is_device<Space>) return leaves_on_host(codes, capacity);
  using Ids = Array<Id, MemoryOf<Space>>;
  const auto count = static_cast<Id>(codes.extent(0));
  const auto leaf_of = allocate<Ids>("GALE::leaf_of", count + Offset(1));
  const Id limit = capacity;
  parallel_for(
      "GALE::octree_leaves", space, count,
      KOKKOS_LAMBDA(Offset i) { leaf_of(i) = begins_leaf(codes, static_cast<Id>(i), limit) ? 1 : 0; });
  const Id leaves = exclusive_scan("GALE::count_leaves", space, count, leaf_of, leaf_of);
  const auto begin = allocate<Ids>("GALE::leaf_begin", leaves);
  parallel_for(
      "GALE::leaf_begin", space, count, KOKKOS_LAMBDA(Offset i) {
        if (leaf_of(i + 1) > leaf_of(i)) begin(leaf_of(i)) = static_cast<Id>(i);
      });
  const auto begin_on_host = on_host(begin);
  return {begin_on_host.data(), begin_on_host.data() + leaves};
}

std::vector<Id> merge_leaves(const std::vector<Id>& leaves, Id count, int capacity) {
  std::vector<Id> begin;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const Id end = leaf + 1 < leaves.size() ? leaves[leaf + 1] : count;
    if (begin.empty() || end - begin.back() > capacity) begin.push_back(leaves[leaf]);
  }
  begin.push_back(count);
  return begin;
}

#define GALE_INSTANTIATE_FOR(Coordinate, Space)                                                                   \
  template GALE_EXPORT void require_finite<Coordinate>(const Space&, const Points<Coordinate, MemoryOf<Space>>&); \
  template GALE_EXPORT Box bounding_box<Coordinate>(const Space&, const Points<Coordinate, MemoryOf<Space>>&);    \
  template GALE_EXPORT Array<std::uint64_t, MemoryOf<Space>> morton_codes<Coordinate>(                            \
      const Space&, const Points<Coordinate, MemoryOf<Space>>&, const Cube&)
#define GALE_INSTANTIATE(Space)        \
  GALE_INSTANTIATE_FOR(float, Space);  \
  GALE_INSTANTIATE_FOR(double, Space); \
  template std::vector<Id> octree_leaves(const Space&, const Array<std::uint64_t, MemoryOf<Space>>&, int)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_FOR

}  // namespace gale::detail
