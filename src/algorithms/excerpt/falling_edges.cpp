#include <algorithm>
#include <utility>

#include <gale/algorithms/excerpt/falling_edges.hpp>
#include <gale/base/error.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// What stands for no edge to go on from.
KOKKOS_FUNCTION FallenEdge no_edge() { return {no_id, no_id, no_id}; }

/// Comes to edges and goes on from there, in a chain of launches. Threads tell of what they have found once, at their
/// ends, but for what is left to other ranks.
struct FallFrom {
  EdgesInKernels edges;
  Array<const std::uint64_t, WorkerMemory> keys;
  FallenEdges found;

  KOKKOS_FUNCTION LaunchPart& part() const { return found.counts(0).part; }
  KOKKOS_FUNCTION Offset open() const { return found.counts(0).open; }

  /// For how many more edges there is room in all that keep them.
  KOKKOS_FUNCTION Offset room() const {
    const Offset of_open = static_cast<Offset>(found.open.extent(0)) - found.counts(0).open;
    const Offset of_left = static_cast<Offset>(found.left.extent(0)) - found.counts(0).left;
    return of_open < of_left ? of_open : of_left;
  }

  /// An edge, and what it is paired with: no_id where another rank knows.
  struct Side {
    Id high, low;
    PairedEdge edge;
  };
  KOKKOS_FUNCTION Side look_at(Id high, Id low) const {
    return {high, low, edges.owned.has(high) ? edges(high, low) : PairedEdge{0, no_id}};
  }

  /// Whether an edge is passed now, or left to another rank. Sides are all asked before the first answer is looked at,
  /// so that these are waited for together.
  KOKKOS_FUNCTION bool is_new(const Side& side) const {
    if (!edges.owned.has(side.high)) return true;
    return side.edge.third != edge_has_vertex && found.passed.insert(side.edge.number);
  }

  /// Comes to an edge that is_new(). Returns it if others fall from it, else none.
  KOKKOS_FUNCTION FallenEdge come_to(const Side& side, Offset& count) const {
    if (edges.owned.has(side.high)) {
      ++count;
      return side.edge.third < 0 ? no_edge() : FallenEdge{side.high, side.low, side.edge.third};
    }
    found.left(atomic_add(&found.counts(0).left, Offset(1))) = {side.high, side.low};
    return no_edge();
  }

  /// Goes on from an open edge.
  KOKKOS_FUNCTION void go_on(Offset i, int steps) const {
    const LaneMask lanes = lanes_here();
    ThreadStack<FallenEdge, 24> open;
    FallenEdge edge = found.open(i);
    Offset count = 0;
    for (int step = 0; step < steps && edge.high != no_id && open.has_room_for(2); ++step) {
      const bool is_low_higher = keys(edge.low) > keys(edge.third);
      const Side side = look_at(edge.high, edge.third);
      const Side other_side = look_at(is_low_higher ? edge.low : edge.third, is_low_higher ? edge.third : edge.low);
      const bool is_side_new = is_new(side), is_other_new = is_new(other_side);
      const FallenEdge one = is_side_new ? come_to(side, count) : no_edge();
      const FallenEdge other = is_other_new ? come_to(other_side, count) : no_edge();
      if (one.high != no_id && other.high != no_id) open.push(other);
      edge = one.high != no_id ? one : other;
      if (edge.high == no_id && !open.is_empty()) edge = open.pop();
    }
    if (edge.high != no_id) open.push(edge);
    meet(lanes);
    open.append_to(found.open, &found.counts(0).open);
    add_in_turn(&found.counts(0).passed, count);
  }
};

/// Forgets what was left to other ranks, who were told.
struct ForgetLeft {
  Array<FallenCounts, WorkerMemory> counts;  ///< one

  KOKKOS_FUNCTION void operator()(Offset i) const { counts(i).left = 0; }
};

/// Begins with some edges, which are left open.
struct BeginEdges {
  FallFrom fall;
  Array<const Id, WorkerMemory> ends;  ///< two for each

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const LaneMask lanes = lanes_here();
    Offset count = 0;
    const FallFrom::Side side = fall.look_at(ends(2 * i), ends(2 * i + 1));
    const FallenEdge edge = fall.is_new(side) ? fall.come_to(side, count) : no_edge();
    ThreadStack<FallenEdge, 1> open;
    if (edge.high != no_id) open.push(edge);
    meet(lanes);
    FallenCounts& counts = fall.found.counts(0);
    open.append_to(fall.found.open, &counts.open);
    add_in_turn(&counts.passed, count);
  }
};

/// Puts the edges of an owned vertex that were passed in a row, in no order.
struct PutPassed {
  EdgesInKernels edges;
  BitTable passed;
  Array<FallenEdge, WorkerMemory> put;
  Array<Offset, WorkerMemory> count;  ///< one

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id high = edges.owned.first + static_cast<Id>(i);
    const Offset first = edges.first_number(high);
    for (int k = 0; k < edges.numbers(high); ++k) {
      if (!passed.has(first + k)) continue;
      const Id low = edges.low(high, k);
      put(atomic_add(&count(0), Offset(1))) = {high, low, edges(high, low).third};
    }
  }
};

}  // namespace

FallingEdges::FallingEdges(const DiscreteGradient& gradient, bool expects_all)
    : edges_(gradient),
      expected_(expects_all ? EdgesInKernels::usual_passed(edges_.count) : EdgesInKernels::few_passed),
      keys_(gradient.order().keys_in<WorkerMemory>()) {
  found_.counts = allocate<decltype(found_.counts)>("GALE::fallen_counts", 1);
  fill("GALE::fallen_counts", space_, found_.counts, FallenCounts());
  found_.passed = BitTable("GALE::passed_edges", space_, edges_.count);
}

std::vector<std::array<Id, 2>> FallingEdges::fall(const std::vector<std::array<Id, 2>>& edges) {
  if (edges.empty()) return {};
  const Offset count = static_cast<Offset>(edges.size());
  make_room(space_, "GALE::ends_of_edges", ends_, 0, 2 * count);
  copy_to_device(ends_.data(), edges[0].data(), edges.size() * sizeof(edges[0]));
  counts_.left = 0;
  parallel_for("GALE::left_edges", space_, 1, ForgetLeft{found_.counts});
  reserve(count);
  parallel_for("GALE::begin_edges", space_, count, BeginEdges{{edges_, keys_, found_}, ends_});
  ChainLength length(count);
  launch_chain("GALE::fall_from_open", space_, count, FallFrom{edges_, keys_, found_}, length.next());
  counts_ = counted(space_, found_.counts);
  while (const Offset open = counts_.open - counts_.part.end) {
    stop_if_asked();
    reserve(open);
    launch_chain("GALE::fall_from_open", space_, open, FallFrom{edges_, keys_, found_}, length.next());
    counts_ = counted(space_, found_.counts);
  }
  if (counts_.left == 0) return {};
  auto left = vector_of<std::array<Id, 2>, WorkerMemory>(first_of(found_.left, counts_.left));
  sort_distinct("GALE::left_edges", left);
  return left;
}

std::vector<std::array<Id, 3>> FallingEdges::passed() const {
  const Offset count = counts_.passed;
  const auto there = allocate<Array<FallenEdge, WorkerMemory>>("GALE::fallen_edges", count);
  const auto put = allocate<Array<Offset, WorkerMemory>>("GALE::fallen_edges_put", 1);
  fill("GALE::fallen_edges_put", space_, put, Offset(0));
  parallel_for("GALE::fallen_edges", space_, edges_.owned.size(), PutPassed{edges_, found_.passed, there, put});
  space_.fence();
  const auto here = on_host(there);
  std::vector<std::array<Id, 3>> all(count);
  parallel_for("GALE::fallen_edges", HostExecutionSpace(), count, [&](Offset i) {
    all[i] = {here(i).high, here(i).low, here(i).third};
  });
  return all;
}

/// Makes room for what a chain's first launch of so many threads finds, in half of the steps that it may take where
/// there is so much, else in one. Throws OutOfMemory.
void FallingEdges::reserve(Offset threads) {
  try {
    make_room_for(threads * StepsOfLaunch::found_in(StepsOfLaunch::most_of(threads) / 2), expected_);
  } catch (const OutOfMemory&) {
    make_room_for(threads * StepsOfLaunch::found_in(1), EdgesInKernels::few_passed);
  }
}

void FallingEdges::make_room_for(Offset more, Offset least) {
  make_room(space_, "GALE::left_edges", found_.left, counts_.left, std::max(counts_.left + more, least / 2));
  make_room(space_, "GALE::open_edges", found_.open, counts_.open, std::max(counts_.open + more, least / 2));
}

}  // namespace gale::detail
