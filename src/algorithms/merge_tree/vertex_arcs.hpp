#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/lifted_tree.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/base/bits.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// How vertices find their nodes on one side: the last one that the side comes to on the way from the vertex's extremum
/// to the root, before the vertex or there.
template <class Memory>
struct SideClimb {
  SideKeys keys;
  Array<Id, Memory> ends;        ///< of each vertex's path, as FollowedPaths has it
  Array<const Id, Memory> leaf;  ///< of each extremum its node, by place
  LiftedTree<Memory> tree;

  KOKKOS_FORCEINLINE_FUNCTION Id node_of(Id vertex) const {
    return tree.climb(leaf(place_of_end(ends(vertex))), keys[vertex]);
  }
};

/// What claims the vertices that find a node on one side: pair_key of a number and an arc. Of two claims the one with
/// the lower number counts.
using ArcClaims = std::vector<std::uint64_t>;
inline constexpr std::uint64_t no_claim = ~std::uint64_t(0);  ///< its arc is no_id

/// The claims of the arcs of one tree, by side and node; none where a side doesn't matter.
using ArcsOfNodes = std::array<ArcClaims, 2>;

/// Finds the arcs of all vertices in each of up to three trees, by input id, and how many vertices are on each arc;
/// nodes count where they are found. A side that no tree has claims on needn't be there.
template <class Space>
void find_arcs_of_vertices(const Space& space, const Mesh& mesh, const std::array<SideClimb<MemoryOf<Space>>, 2>& sides,
                           const std::vector<ArcsOfNodes>& claims, std::vector<MergeTree>& trees);

/// The number of vertices on each of so many arcs; `arc_of` is that of each, or no_id.
template <class Space>
std::vector<Id> sizes_of_arcs(const Space& space, std::size_t arcs, const Array<const Id, MemoryOf<Space>>& arc_of);

/// The nodes that some vertices find on one side.
template <class Space>
std::vector<Id> nodes_of(const Space& space, const SideClimb<MemoryOf<Space>>& side, const std::vector<Id>& vertices);

}  // namespace gale::detail
