#include <gale/algorithms/excerpt/falling_edges.hpp>
#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// Edges that a thread comes to before it looks whether there is room for more: a first one, and two sides.
constexpr Offset most_at_once = 3;

/// Steps that a thread goes on in one launch, so that edges that were left open don't wait for the longest way.
constexpr int most_steps = 16;

/// What stands for no edge to go on from.
KOKKOS_FUNCTION FallenEdge no_edge() { return {no_id, no_id, no_id}; }

/// Comes to edges and goes on from there, one thread of a launch.
struct FallFrom {
  EdgesInKernels edges;
  Array<const std::uint64_t, WorkerMemory> keys;
  FallenEdges found;
  Offset threads;  ///< of the launch

  /// An edge, and what it is paired with: no_id where another rank knows.
  KOKKOS_FUNCTION FallenEdge look_at(Id high, Id low) const {
    return {high, low, edges.owned.has(high) ? edges(high, low).third : no_id};
  }

  /// Comes to an edge. Returns it if others fall from it and it is new, else none.
  KOKKOS_FUNCTION FallenEdge come_to(const FallenEdge& edge) const {
    const bool is_here = edges.owned.has(edge.high);
    if (is_here && edge.third == edge_has_vertex) return no_edge();
    bool is_new = false;
    found.known.insert(pair_key(edge.high, edge.low), is_new);
    if (!is_new) return no_edge();
    if (!is_here) {
      found.left(atomic_add(&found.counts(0).left, Offset(1))) = {edge.high, edge.low};
      return no_edge();
    }
    found.passed(atomic_add(&found.counts(0).passed, Offset(1))) = edge;
    return edge.third < 0 ? no_edge() : edge;
  }

  KOKKOS_FUNCTION void leave_open(const FallenEdge& edge) const {
    if (edge.high != no_id) found.open(atomic_add(&found.counts(0).open, Offset(1))) = edge;
  }

  /// Goes on from an edge, a first step in any case.
  KOKKOS_FUNCTION void go_on(FallenEdge edge) const {
    for (int step = 0; edge.high != no_id; ++step) {
      if (step == most_steps || (step > 0 && !has_room())) return leave_open(edge);
      const FallenEdge sides[] = {side(edge.high, edge.third), side(edge.low, edge.third)};
      const FallenEdge one = come_to(sides[0]), other = come_to(sides[1]);
      const bool has_one = one.high != no_id;
      if (has_one) leave_open(other);
      edge = has_one ? one : other;
    }
  }

 private:
  KOKKOS_FUNCTION FallenEdge side(Id end, Id third) const {
    const bool in_order = keys(end) > keys(third);
    return look_at(in_order ? end : third, in_order ? third : end);
  }

  /// Is there room for a step of each thread?
  KOKKOS_FUNCTION bool has_room() const {
    const FallenCounts& counts = found.counts(0);
    const Offset more = most_at_once * threads;
    const Offset passed = atomic_read(&counts.passed) + more, left = atomic_read(&counts.left) + more;
    return detail::has_room(found.passed, passed) && detail::has_room(found.left, left) &&
           detail::has_room(found.open, atomic_read(&counts.open) + more) && found.known.has_room(passed + left);
  }
};

/// Goes on from edges that were left open.
struct FallFromOpen {
  FallFrom fall;
  Offset first;

  KOKKOS_FUNCTION void operator()(Offset i) const { fall.go_on(fall.found.open(first + i)); }
};

/// Begins with some edges.
struct BeginEdges {
  FallFrom fall;
  Array<const Id, WorkerMemory> ends;  ///< two for each

  KOKKOS_FUNCTION void operator()(Offset i) const {
    fall.go_on(fall.come_to(fall.look_at(ends(2 * i), ends(2 * i + 1))));
  }
};

}  // namespace

FallingEdges::FallingEdges(const DiscreteGradient& gradient)
    : edges_(gradient), keys_(gradient.order().keys_in<WorkerMemory>()) {
  constexpr Offset least = 1 << 16;
  found_ = {KeyTable(space_, 4 * least), allocate<decltype(found_.passed)>("GALE::fallen_edges", least),
            allocate<decltype(found_.open)>("GALE::open_edges", least),
            allocate<decltype(found_.left)>("GALE::left_edges", least),
            allocate<decltype(found_.counts)>("GALE::fallen_counts", 1)};
  fill("GALE::fallen_counts", space_, found_.counts, FallenCounts());
}

std::vector<std::array<Id, 2>> FallingEdges::fall(const std::vector<std::array<Id, 2>>& edges) {
  if (edges.empty()) return {};
  const Offset left_before = counts_.left, count = static_cast<Offset>(edges.size());
  const auto ends = in_memory<WorkerMemory>(Array<const Id, HostMemory>(edges[0].data(), 2 * edges.size()));
  Offset first = counts_.open;
  reserve_first(count);
  parallel_for("GALE::begin_edges", space_, count, BeginEdges{{edges_, keys_, found_, count}, ends});
  take_counts();
  while (first < counts_.open) {
    stop_if_asked();
    const Offset open = counts_.open - first;
    reserve(most_at_once * open);
    parallel_for("GALE::fall_from_open", space_, open, FallFromOpen{{edges_, keys_, found_, open}, first});
    first += open;
    take_counts();
  }
  const Array<std::array<Id, 2>, WorkerMemory> left =
      Kokkos::subview(found_.left, std::make_pair(std::size_t(left_before), std::size_t(counts_.left)));
  return vector_of(left);
}

std::vector<std::array<Id, 3>> FallingEdges::passed() const {
  const auto here = on_host(first_of(found_.passed, counts_.passed));
  std::vector<std::array<Id, 3>> all(counts_.passed);
  parallel_for("GALE::fallen_edges", HostExecutionSpace(), counts_.passed, [&](Offset i) {
    all[i] = {here(i).high, here(i).low, here(i).third};
  });
  return all;
}

/// Makes room for so many more edges that kernels may come to.
void FallingEdges::reserve(Offset more) {
  make_room(space_, "GALE::fallen_edges", found_.passed, counts_.passed, counts_.passed + more);
  make_room(space_, "GALE::left_edges", found_.left, counts_.left, counts_.left + more);
  make_room(space_, "GALE::open_edges", found_.open, counts_.open, counts_.open + more);
  make_room(space_, found_.known, counts_.passed + counts_.left + more);
}

/// Makes room for so many edges to begin with, and for what most come to where there is room for that.
void FallingEdges::reserve_first(Offset count) {
  constexpr Offset behind_each = 16;
  try {
    reserve((counts_.passed == 0 ? behind_each : most_at_once) * count);
  } catch (const OutOfMemory&) {
    reserve(most_at_once * count);
  }
}

/// Learns how many kernels have found.
void FallingEdges::take_counts() {
  Kokkos::deep_copy(space_, Kokkos::View<FallenCounts*, HostMemory, Kokkos::MemoryUnmanaged>(&counts_, 1),
                    found_.counts);
  space_.fence();
}

}  // namespace gale::detail
