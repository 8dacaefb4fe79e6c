#include <gale/algorithms/merge_tree/vertex_arcs.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// The claims of a tree and what becomes of them, where code that runs on `Memory` reads and writes them.
template <class Memory>
struct ClaimsOfTree {
  Array<const std::uint64_t, Memory> by_node[2];
  Array<Id, Memory> arc_of;
};

/// Finds the arcs of a vertex.
template <class Memory>
struct FindArcs {
  static constexpr int most_trees = 3;
  OtherIds input;
  SideClimb<Memory> sides[2];
  bool climbs[2] = {false, false};
  ClaimsOfTree<Memory> trees[most_trees];
  int count = 0;

  KOKKOS_FUNCTION void operator()(Offset v) const {
    const auto vertex = static_cast<Id>(v);
    Id node[2] = {no_id, no_id};
    for (int side = 0; side < 2; ++side) {
      if (climbs[side]) node[side] = sides[side].node_of(vertex);
    }
    for (int tree = 0; tree < count; ++tree) {
      std::uint64_t claim = no_claim;
      for (int side = 0; side < 2; ++side) {
        const auto& claims = trees[tree].by_node[side];
        if (claims.extent(0) > 0 && claims(node[side]) < claim) claim = claims(node[side]);
      }
      trees[tree].arc_of(input[vertex]) = pair_second(claim);
    }
  }
};

/// The number of vertices that a thread of a device counts, one after the other.
constexpr Offset stretch = 64;

/// Counts vertices on their arcs, on a device those of the i-th stretch.
template <class Memory>
struct CountOnArcs {
  Array<const Id, Memory> arc_of;
  Array<Id, Memory> sizes;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Offset begin = i * stretch, count = static_cast<Offset>(arc_of.extent(0));
    count_from(begin, begin + stretch < count ? begin + stretch : count);
  }

  /// Counts those from begin to end - 1 by runs, as neighbours are mostly on one arc: to add one by one would wait for
  /// what was added.
  KOKKOS_FUNCTION void count_from(Offset begin, Offset end) const {
    Id last = no_id, run = 0;
    for (Offset i = begin; i < end; ++i, ++run) {
      const Id arc = arc_of(i);
      if (arc == last) continue;
      add(last, run);
      last = arc;
      run = 0;
    }
    add(last, run);
  }

 private:
  KOKKOS_FUNCTION void add(Id arc, Id run) const {
    if (arc == no_id) return;
    if constexpr (is_device_memory<Memory>) {
      Kokkos::atomic_add(&sizes(arc), run);
    } else {
      sizes(arc) += run;
    }
  }
};

/// The number of vertices on each of so many arcs; on a device once what is enqueued is done.
template <class Space>
Array<Id, MemoryOf<Space>> counted(const Space& space, std::size_t arcs,
                                   const Array<const Id, MemoryOf<Space>>& arc_of) {
  using Count = CountOnArcs<MemoryOf<Space>>;
  const Offset count = static_cast<Offset>(arc_of.extent(0));
  const auto sizes = allocate<Array<Id, MemoryOf<Space>>>("GALE::sizes_of_arcs", arcs);
  if constexpr (is_device<Space>) {
    Kokkos::deep_copy(space, sizes, Id(0));
    parallel_for("GALE::count_on_arcs", space, (count + stretch - 1) / stretch, Count{arc_of, sizes});
  } else {
    const auto of_all = of_parts("GALE::count_on_arcs", count, [&](Offset begin, Offset end) {
      std::vector<Id> mine(arcs, 0);
      Count{arc_of, Array<Id, HostMemory>(mine.data(), arcs)}.count_from(begin, end);
      return mine;
    });
    parallel_for("GALE::add_on_arcs", space, static_cast<Offset>(arcs), [&](Offset arc) {
      sizes(arc) = 0;
      for (const std::vector<Id>& mine : of_all) sizes(arc) += mine[arc];
    });
  }
  return sizes;
}

/// Finds the node of a vertex on one side.
template <class Memory>
struct NodeOf {
  SideClimb<Memory> side;
  KOKKOS_FUNCTION Id operator()(Id vertex) const { return side.node_of(vertex); }
};

}  // namespace

template <class Space>
void find_arcs_of_vertices(const Space& space, const Mesh& mesh, const std::array<SideClimb<MemoryOf<Space>>, 2>& sides,
                           const std::vector<ArcsOfNodes>& claims, std::vector<MergeTree>& trees) {
  using Memory = MemoryOf<Space>;
  FindArcs<Memory> find;
  find.input = mesh.vertices_in_input<Memory>();
  find.count = static_cast<int>(trees.size());
  const auto make_room = [&] {
    for (MergeTree& tree : trees) tree.arc_of = unwritten<Id>(mesh.vertices());
  };
  if constexpr (!is_device<Space>) make_room();
  for (int tree = 0; tree < find.count; ++tree) {
    for (const Side side : {below, above}) {
      find.trees[tree].by_node[side] = in_memory<Memory>(claims[tree][side]);
      find.climbs[side] |= !claims[tree][side].empty();
    }
    if constexpr (is_device<Space>) {
      find.trees[tree].arc_of = allocate<Array<Id, Memory>>("GALE::arc_of", mesh.vertices());
    } else {
      find.trees[tree].arc_of = Array<Id, Memory>(trees[tree].arc_of.data(), mesh.vertices());
    }
  }
  for (const Side side : {below, above}) find.sides[side] = sides[side];
  parallel_for("GALE::find_arcs", space, mesh.vertices(), find);
  std::vector<Array<Id, Memory>> sizes;
  for (int tree = 0; tree < find.count; ++tree)
    sizes.push_back(counted<Space>(space, trees[tree].arcs.size(), find.trees[tree].arc_of));
  if constexpr (is_device<Space>) make_room();  // meanwhile
  space.fence();
  for (std::size_t tree = 0; tree < trees.size(); ++tree) {
    const auto& arc_of = find.trees[tree].arc_of;
    if constexpr (is_device<Space>)
      copy_from_device(trees[tree].arc_of.data(), arc_of.data(), arc_of.extent(0) * sizeof(Id));
    const std::vector<Id> of_arcs = vector_of(sizes[tree]);
    for (std::size_t arc = 0; arc < of_arcs.size(); ++arc) trees[tree].arcs[arc].size = of_arcs[arc];
  }
}

template <class Space>
std::vector<Id> sizes_of_arcs(const Space& space, std::size_t arcs, const Array<const Id, MemoryOf<Space>>& arc_of) {
  const auto sizes = counted(space, arcs, arc_of);
  space.fence();
  return vector_of(sizes);
}

template <class Space>
std::vector<Id> nodes_of(const Space& space, const SideClimb<MemoryOf<Space>>& side, const std::vector<Id>& vertices) {
  return results_at("GALE::nodes_of", space, vertices, NodeOf<MemoryOf<Space>>{side});
}

#define GALE_INSTANTIATE(Space)                                                                                      \
  template void find_arcs_of_vertices<Space>(const Space&, const Mesh&,                                              \
                                             const std::array<SideClimb<MemoryOf<Space>>, 2>&,                       \
                                             const std::vector<ArcsOfNodes>&, std::vector<MergeTree>&);              \
  template std::vector<Id> sizes_of_arcs<Space>(const Space&, std::size_t, const Array<const Id, MemoryOf<Space>>&); \
  template std::vector<Id> nodes_of<Space>(const Space&, const SideClimb<MemoryOf<Space>>&, const std::vector<Id>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
