#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include <gale/algorithms/merge_tree/gathered_graph.hpp>
#include <gale/algorithms/merge_tree/keys_here.hpp>
#include <gale/algorithms/merge_tree/tree_maker.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

/// The way of this rank's vertices to their nodes.
class VertexClimbs {
 public:
  VertexClimbs(const VertexOrder& order, const GatheredGraph& gathered,
               const std::array<std::unique_ptr<SideOnRanks>, 2>& sides, const TreeMaker<HostExecutionSpace>& maker) {
    const Mesh& mesh = order.mesh();
    const Ranks& ranks = mesh.exchange().ranks();
    std::unique_ptr<const KeysHere> here;
    together(ranks, [&] { here = std::make_unique<const KeysHere>(order, gathered.vertices); });
    for (const Side side : {below, above}) {
      if (!maker.uses(side)) continue;
      together(ranks, [&] { find_ends(mesh, *sides[side], gathered.places_of_extrema(side)); });
      mesh.exchange().from_owners()(ranks, by_input_.data(), by_input_.data());
      together(ranks, [&] {
        const auto ends = allocate<Array<Id, HostMemory>>("GALE::ends_of_paths", mesh.vertices());
        const OtherIds input = mesh.vertices_in_input();
        parallel_for("GALE::ends_of_paths", HostExecutionSpace(), mesh.vertices(),
                     [&](Offset v) { ends(v) = by_input_(input[static_cast<Id>(v)]); });
        climbs[side] = maker.climbs()[side];
        climbs[side].ends = ends;
        find_keys(order, gathered, *here, side);
        climbs[side].keys = SideKeys(keys_[side].data(), side);
      });
    }
  }

  std::array<SideClimb<HostMemory>, 2> climbs;

 private:
  void find_ends(const Mesh& mesh, const SideOnRanks& side, const std::unordered_map<GlobalId, Id>& places) {
    std::vector<Id> place_of_end;
    const PathsOnRanks& paths = *side.paths;
    for (Id end = 0; end < paths.ends(); ++end) {
      const PathStop stop = paths.final_stop(end);  // nobody asks for some: no path of this rank's comes there
      place_of_end.push_back(stop.rank == PathStop::critical ? places.at(stop.id) : no_id);
    }
    if (by_input_.extent(0) == 0) by_input_ = allocate<Array<Id, HostMemory>>("GALE::ends_by_input", mesh.vertices());
    const OtherIds input = mesh.vertices_in_input();
    const Interval owned = mesh.owned_vertices();
    parallel_for("GALE::ends_by_input", HostExecutionSpace(), owned.size(), [&](Offset i) {
      const Id v = owned.first + static_cast<Id>(i);
      by_input_(input[v]) = end_at(place_of_end[paths.end(v)]);
    });
  }

  /// Keys of all that this rank holds that compare with those of what was gathered: the place of the last of these that
  /// isn't above, or of the first that isn't below.
  void find_keys(const VertexOrder& order, const GatheredGraph& gathered, const KeysHere& here, Side side) {
    const Mesh& mesh = order.mesh();
    const std::uint64_t* const small = gathered.order().keys();
    // Keys of an excerpt's order ascend with its vertices: those of places are what trees compare.
    std::vector<std::uint64_t> sorted(small, small + gathered.mesh().vertices());
    std::sort(sorted.begin(), sorted.end());
    const std::uint64_t* const keys = order.keys();
    keys_[side] = allocate<Array<std::uint64_t, HostMemory>>("GALE::keys_among_gathered", mesh.vertices());
    parallel_for("GALE::keys_among_gathered", HostExecutionSpace(), mesh.vertices(), [&](Offset v) {
      const auto [first, is_one] = here.place_of(keys[v]);
      const std::int64_t place = is_one || side == above ? first : first - 1;
      keys_[side](v) = place < 0                                          ? 0
                       : place < static_cast<std::int64_t>(sorted.size()) ? sorted[place]
                                                                          : ~std::uint64_t(0);
    });
  }

  Array<Id, HostMemory> by_input_;
  std::array<Array<std::uint64_t, HostMemory>, 2> keys_;
};

}  // namespace gale::detail
