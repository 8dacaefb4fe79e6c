#include <algorithm>
#include <utility>

#include <gale/algorithms/excerpt/falling_edges.hpp>
#include <gale/base/error.hpp>
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
    const FallenCounts& counts = found.counts(0);
    const Offset of_all = found.all.room() - counts.all;
    const Offset of_open = static_cast<Offset>(found.open.extent(0)) - counts.open;
    const Offset of_left = static_cast<Offset>(found.left.extent(0)) - counts.left;
    const Offset of_lists = of_open < of_left ? of_open : of_left;
    return of_all < of_lists ? of_all : of_lists;
  }

  /// An edge by its key, and what it is paired with: no_id where another rank knows.
  KOKKOS_FUNCTION FallenEdge look_at(std::uint64_t key) const {
    const Id high = pair_first(key), low = pair_second(key);
    return {high, low, edges.owned.has(high) ? edges(high, low).third : no_id};
  }

  /// Whether nothing falls from an edge, nor is it to be told.
  KOKKOS_FUNCTION bool ends_at(const FallenEdge& edge) const { return edge.third == edge_has_vertex; }

  /// Claims an edge's place among all, by what was there.
  KOKKOS_FUNCTION std::uint64_t claim(const FallenEdge& edge, std::uint64_t key, std::uint64_t there) const {
    return ends_at(edge) ? key : found.all.claim(key, there);
  }

  /// Comes to an edge, for which claim() was `there`. Returns it if others fall from it and it is new, else none.
  KOKKOS_FUNCTION FallenEdge come_to(const FallenEdge& edge, std::uint64_t key, std::uint64_t there,
                                     Offset& count) const {
    bool is_new = false;
    found.all.insert(key, there, is_new);
    if (!is_new) return no_edge();
    ++count;
    if (edges.owned.has(edge.high)) return edge.third < 0 ? no_edge() : edge;
    found.left(atomic_add(&found.counts(0).left, Offset(1))) = {edge.high, edge.low};
    return no_edge();
  }

  /// Goes on from an open edge.
  KOKKOS_FUNCTION void go_on(Offset i, int steps) const {
    const LaneMask lanes = lanes_here();
    ThreadStack<FallenEdge, 24> open;
    FallenEdge edge = found.open(i);
    Offset count = 0;
    for (int step = 0; step < steps && edge.high != no_id && open.has_room_for(2); ++step) {
      const std::uint64_t key = pair_key(edge.high, edge.third), other_key = ordered(edge.low, edge.third);
      std::uint64_t there = found.all.first_there(key), other_there = found.all.first_there(other_key);
      const FallenEdge side = look_at(key), other_side = look_at(other_key);
      there = claim(side, key, there);
      other_there = claim(other_side, other_key, other_there);
      const FallenEdge one = come_to(side, key, there, count);
      const FallenEdge other = come_to(other_side, other_key, other_there, count);
      if (one.high != no_id && other.high != no_id) open.push(other);
      edge = one.high != no_id ? one : other;
      if (edge.high == no_id && !open.is_empty()) edge = open.pop();
    }
    if (edge.high != no_id) open.push(edge);
    meet(lanes);
    open.append_to(found.open, &found.counts(0).open);
    add_in_turn(&found.counts(0).all, count);
  }

 private:
  /// The key of an edge between two vertices.
  KOKKOS_FUNCTION std::uint64_t ordered(Id a, Id b) const {
    return keys(a) > keys(b) ? pair_key(a, b) : pair_key(b, a);
  }
};

/// Begins with some edges, which are left open.
struct BeginEdges {
  FallFrom fall;
  Array<const Id, WorkerMemory> ends;  ///< two for each

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const LaneMask lanes = lanes_here();
    Offset count = 0;
    const std::uint64_t key = pair_key(ends(2 * i), ends(2 * i + 1));
    const FallenEdge at = fall.look_at(key);
    const FallenEdge edge = fall.come_to(at, key, fall.claim(at, key, fall.found.all.first_there(key)), count);
    ThreadStack<FallenEdge, 1> open;
    if (edge.high != no_id) open.push(edge);
    meet(lanes);
    FallenCounts& counts = fall.found.counts(0);
    open.append_to(fall.found.open, &counts.open);
    add_in_turn(&counts.all, count);
  }
};

/// Puts the edges of a table that this rank follows in a row, in no order.
struct PutPassed {
  EdgesInKernels edges;
  KeyTable all;
  Array<FallenEdge, WorkerMemory> passed;
  Array<Offset, WorkerMemory> count;  ///< one

  KOKKOS_FUNCTION void operator()(Offset place) const {
    const std::uint64_t key = all.at(place);
    if (key == KeyTable::none) return;
    const Id high = pair_first(key), low = pair_second(key);
    if (!edges.owned.has(high)) return;
    passed(atomic_add(&count(0), Offset(1))) = {high, low, edges(high, low).third};
  }
};

}  // namespace

FallingEdges::FallingEdges(const DiscreteGradient& gradient, bool expects_all)
    : edges_(gradient),
      expected_(expects_all ? EdgesInKernels::usual_passed(edges_.count) : EdgesInKernels::few_passed),
      keys_(gradient.order().keys_in<WorkerMemory>()) {
  found_.counts = allocate<decltype(found_.counts)>("GALE::fallen_counts", 1);
  fill("GALE::fallen_counts", space_, found_.counts, FallenCounts());
}

std::vector<std::array<Id, 2>> FallingEdges::fall(const std::vector<std::array<Id, 2>>& edges) {
  if (edges.empty()) return {};
  const Offset left_before = counts_.left, count = static_cast<Offset>(edges.size());
  make_room(space_, "GALE::ends_of_edges", ends_, 0, 2 * count);
  copy_to_device(ends_.data(), edges[0].data(), edges.size() * sizeof(edges[0]));
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
  if (counts_.left == left_before) return {};
  const Array<std::array<Id, 2>, WorkerMemory> left =
      Kokkos::subview(found_.left, std::make_pair(std::size_t(left_before), std::size_t(counts_.left)));
  return vector_of(left);
}

std::vector<std::array<Id, 3>> FallingEdges::passed() const {
  const Offset count = counts_.all - counts_.left;
  const auto there = allocate<Array<FallenEdge, WorkerMemory>>("GALE::fallen_edges", count);
  const auto put = allocate<Array<Offset, WorkerMemory>>("GALE::fallen_edges_put", 1);
  fill("GALE::fallen_edges_put", space_, put, Offset(0));
  parallel_for("GALE::fallen_edges", space_, found_.all.places(), PutPassed{edges_, found_.all, there, put});
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
  make_room(space_, found_.all, std::max(counts_.all + more, least));
}

}  // namespace gale::detail
