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

/// Finds the node of a vertex on one side.
template <class Memory>
struct NodeOf {
  SideClimb<Memory> side;
  KOKKOS_FUNCTION Id operator()(Id vertex) const { return side.node_of(vertex); }
};

}  // namespace

template <class Space>
std::vector<std::vector<Id>> arcs_of_vertices(const Space& space, const Mesh& mesh,
                                              const std::array<SideClimb<MemoryOf<Space>>, 2>& sides,
                                              const std::vector<ArcsOfNodes>& trees) {
  using Memory = MemoryOf<Space>;
  FindArcs<Memory> find;
  find.input = mesh.vertices_in_input<Memory>();
  find.count = static_cast<int>(trees.size());
  std::vector<std::vector<Id>> found(trees.size());
  const auto make_room = [&] {
    for (std::vector<Id>& arcs : found) arcs = unwritten<Id>(mesh.vertices());
  };
  if constexpr (!is_device<Space>) make_room();
  for (int tree = 0; tree < find.count; ++tree) {
    for (const Side side : {below, above}) {
      find.trees[tree].by_node[side] = in_memory<Memory>(trees[tree][side]);
      find.climbs[side] |= !trees[tree][side].empty();
    }
    if constexpr (is_device<Space>) {
      find.trees[tree].arc_of = allocate<Array<Id, Memory>>("GALE::arc_of", mesh.vertices());
    } else {
      find.trees[tree].arc_of = Array<Id, Memory>(found[tree].data(), found[tree].size());
    }
  }
  for (const Side side : {below, above}) find.sides[side] = sides[side];
  parallel_for("GALE::find_arcs", space, mesh.vertices(), find);
  if constexpr (is_device<Space>) make_room();  // meanwhile
  space.fence();
  if constexpr (is_device<Space>) {
    for (int tree = 0; tree < find.count; ++tree)
      copy_from_device(found[tree].data(), find.trees[tree].arc_of.data(), found[tree].size() * sizeof(Id));
  }
  return found;
}

template <class Space>
std::vector<Id> nodes_of(const Space& space, const SideClimb<MemoryOf<Space>>& side, const std::vector<Id>& vertices) {
  return results_at("GALE::nodes_of", space, vertices, NodeOf<MemoryOf<Space>>{side});
}

#define GALE_INSTANTIATE(Space)                                                                                      \
  template std::vector<std::vector<Id>> arcs_of_vertices<Space>(                                                     \
      const Space&, const Mesh&, const std::array<SideClimb<MemoryOf<Space>>, 2>&, const std::vector<ArcsOfNodes>&); \
  template std::vector<Id> nodes_of<Space>(const Space&, const SideClimb<MemoryOf<Space>>&, const std::vector<Id>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
