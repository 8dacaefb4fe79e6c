#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/merge_tree/gathered_graph.hpp>
#include <gale/algorithms/merge_tree/keys_here.hpp>
#include <gale/algorithms/merge_tree/tree_maker.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Puts a vertex that a rank holds among what was gathered: its key compares with those as it does, and is that of the
/// last of these that isn't above, or of the first that isn't below.
template <class Memory>
struct PutAmongGathered {
  KeysHere<Memory> here;
  Array<const std::uint64_t, Memory> keys;  ///< of vertices
  std::int64_t gathered;                    ///< how many were gathered
  Array<const Id, Memory> places;           ///< of the extrema at which paths end, by vertex's input id
  OtherIds input;
  Side side;
  Array<std::uint64_t, Memory> keys_among;
  Array<Id, Memory> ends;

  KOKKOS_FUNCTION void operator()(Offset v) const {
    const auto found = here.place_of(keys(v));
    const std::int64_t place = found.is_one || side == above ? found.first : found.first - 1;
    keys_among(v) = place < gathered ? GatheredGraph::key_of(place) : ~std::uint64_t(0);
    ends(v) = end_at(places(input[static_cast<Id>(v)]));
  }
};

/// The way of this rank's vertices to their nodes, where code that runs in a space follows it.
template <class Space>
class VertexClimbs {
  using Memory = MemoryOf<Space>;

 public:
  /// `places` has by side the places of the extrema at which paths of vertices end, by input id. Not collective.
  VertexClimbs(const Space& space, const VertexOrder& order, const GatheredGraph& gathered,
               const std::array<Mirrored<Id>, 2>& places, const TreeMaker<HostExecutionSpace>& maker) {
    const Mesh& mesh = order.mesh();
    const KeysHere<Memory> here(order, gathered.vertices);
    for (const Side side : {below, above}) {
      if (!maker.uses(side)) continue;
      const SideClimb<HostMemory>& climb = maker.climbs()[side];
      keys_[side] = allocate<Array<std::uint64_t, Memory>>("GALE::keys_among_gathered", mesh.vertices());
      const auto ends = allocate<Array<Id, Memory>>("GALE::ends_of_paths", mesh.vertices());
      parallel_for("GALE::put_among_gathered", space, mesh.vertices(),
                   PutAmongGathered<Memory>{
                       here, order.keys_in<Memory>(), static_cast<std::int64_t>(gathered.vertices.size()),
                       places[side].in<Memory>(), mesh.vertices_in_input<Memory>(), side, keys_[side], ends});
      climbs[side] = {SideKeys(keys_[side].data(), side),
                      ends,
                      in_memory<Memory>(climb.leaf),
                      {in_memory<Memory>(climb.tree.up), in_memory<Memory>(climb.tree.keys), climb.tree.levels}};
    }
    space.fence();
  }

  std::array<SideClimb<Memory>, 2> climbs;

 private:
  std::array<Array<std::uint64_t, Memory>, 2> keys_;
};

}  // namespace gale::detail
