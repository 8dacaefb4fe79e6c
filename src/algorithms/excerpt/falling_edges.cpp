#include <gale/algorithms/excerpt/falling_edges.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// Comes to an edge.
struct ComeTo {
  EdgesInKernels edges;
  FallenEdges found;

  KOKKOS_FUNCTION void operator()(Id high, Id low) const {
    const bool is_here = edges.owned.has(high);
    const Id third = is_here ? edges(high, low).third : no_id;
    if (third == edge_has_vertex) return;
    bool is_new = false;
    found.known.insert(pair_key(high, low), is_new);
    if (!is_new) return;
    if (is_here) {
      found.passed(atomic_add(&found.counts(0).passed, Offset(1))) = {high, low, third};
    } else {
      found.left(atomic_add(&found.counts(0).left, Offset(1))) = {high, low};
    }
  }
};

/// Goes on from the edges of a layer.
struct CrossTriangle {
  ComeTo come_to;
  Array<const std::uint64_t, WorkerMemory> keys;
  Offset first;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const FallenEdge edge = come_to.found.passed(first + i);
    if (edge.third < 0) return;
    come_to_side(edge.high, edge.third);
    come_to_side(edge.low, edge.third);
  }

 private:
  KOKKOS_FUNCTION void come_to_side(Id end, Id third) const {
    const bool in_order = keys(end) > keys(third);
    come_to(in_order ? end : third, in_order ? third : end);
  }
};

/// Begins with some edges.
struct BeginEdges {
  ComeTo come_to;
  Array<const Id, WorkerMemory> ends;  ///< two for each

  KOKKOS_FUNCTION void operator()(Offset i) const { come_to(ends(2 * i), ends(2 * i + 1)); }
};

/// Puts the keys of a table into a larger one.
struct CopyKeys {
  KeyTable from, to;

  KOKKOS_FUNCTION void operator()(Offset place) const {
    bool is_new;
    if (from.at(place) != KeyTable::none) to.insert(from.at(place), is_new);
  }
};

}  // namespace

FallingEdges::FallingEdges(const DiscreteGradient& gradient)
    : edges_(gradient), keys_(gradient.order().keys_in<WorkerMemory>()) {
  constexpr Offset least = 4096;
  found_ = {KeyTable(space_, 4 * least), allocate<decltype(found_.passed)>("GALE::fallen_edges", least),
            allocate<decltype(found_.left)>("GALE::left_edges", least),
            allocate<decltype(found_.counts)>("GALE::fallen_counts", 1)};
  fill("GALE::fallen_counts", space_, found_.counts, FallenCounts());
}

std::vector<std::array<Id, 2>> FallingEdges::fall(const std::vector<std::array<Id, 2>>& edges) {
  if (edges.empty()) return {};
  const Offset left_before = counts_.left, count = static_cast<Offset>(edges.size());
  const auto ends = in_memory<WorkerMemory>(Array<const Id, HostMemory>(edges[0].data(), 2 * edges.size()));
  Offset first = counts_.passed;
  reserve(count);
  parallel_for("GALE::begin_edges", space_, count, BeginEdges{{edges_, found_}, ends});
  take_counts();
  while (first < counts_.passed) {
    stop_if_asked();
    const Offset layer = counts_.passed - first;
    reserve(2 * layer);
    parallel_for("GALE::cross_triangles", space_, layer, CrossTriangle{{edges_, found_}, keys_, first});
    first += layer;
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
  const Offset known = counts_.passed + counts_.left + more;
  if (10 * known <= 7 * found_.known.places()) return;
  const KeyTable larger(space_, Offset(1) << bits_for(2 * known));
  parallel_for("GALE::copy_keys", space_, found_.known.places(), CopyKeys{found_.known, larger});
  space_.fence();
  found_.known = larger;
}

/// Learns how many kernels have found.
void FallingEdges::take_counts() {
  Kokkos::deep_copy(space_, Kokkos::View<FallenCounts*, HostMemory, Kokkos::MemoryUnmanaged>(&counts_, 1),
                    found_.counts);
  space_.fence();
}

}  // namespace gale::detail
