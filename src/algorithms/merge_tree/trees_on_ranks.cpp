#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/merge_tree/vertex_climbs.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

/// Gives a tree the arcs of what this rank holds, and counts those of all. Collective.
void set_arcs_on_ranks(const Mesh& mesh, const Mesh& excerpt, MergeTree& tree, std::vector<Id> arc_of) {
  const Ranks& ranks = mesh.exchange().ranks();
  std::vector<Id> node;  // by input id; no_id where it isn't here
  std::vector<std::int64_t> sizes;
  together(ranks, [&] {
    node.resize(tree.vertices.size());
    parallel_for("GALE::nodes_here", HostExecutionSpace(), node.size(), [&](Offset i) {
      node[i] = mesh.vertex_of(excerpt.vertex_id(tree.vertices[i]));
      if (node[i] != no_id) arc_of[node[i]] = no_id;
    });
    const std::vector<Id> held = sizes_of(tree.arcs.size(), mesh.vertices(), [&](Offset i) { return arc_of[i]; });
    const auto& ghosts = mesh.exchange().from_owners().slots();
    const std::vector<Id> of_others =
        sizes_of(tree.arcs.size(), ghosts.extent(0), [&](Offset i) { return arc_of[ghosts(i)]; });
    sizes.resize(held.size());
    std::transform(held.begin(), held.end(), of_others.begin(), sizes.begin(), std::minus<std::int64_t>());
    require_ids("arcs of trees", static_cast<Offset>(sizes.size()));
  });
  ranks.sum(sizes.data(), static_cast<int>(sizes.size()));
  together(ranks, [&] {
    for (std::size_t i = 0; i < tree.arcs.size(); ++i) {
      require_ids("vertices on an arc", sizes[i]);
      tree.arcs[i].size = static_cast<Id>(sizes[i]);
      for (const Id end : {tree.arcs[i].lower, tree.arcs[i].upper}) {
        if (node[end] != no_id) arc_of[node[end]] = static_cast<Id>(i);
      }
    }
    tree.arc_of = std::move(arc_of);
    tree.excerpt = excerpt;
  });
}

}  // namespace

std::vector<MergeTree> trees_on_ranks(const VertexOrder& order, MirroredGraph graph, const std::vector<Tree>& trees,
                                      const MergeTreeOptions& options) {
  const Mesh& mesh = order.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  std::array<std::unique_ptr<SideOnRanks>, 2> sides;
  for (const Side side : {below, above})
    sides[side] = std::make_unique<SideOnRanks>(order, std::move(graph[side]), are_made_of(side, trees));
  const GatheredGraph gathered(order, sides);
  std::vector<double> values;
  if (options.threshold != 0) values = values_at(gathered.mesh(), mesh, options.value);
  const ThresholdOfTree threshold{
      options.threshold, [&](Id vertex) {
        if (std::isnan(values[vertex])) {
          throw Error("vertex " + std::to_string(gathered.mesh().vertex_id(vertex)) + " has no field value: it is NaN");
        }
        return values[vertex];
      }};
  std::optional<TreeMaker<HostExecutionSpace>> maker;
  std::vector<ArcsOfNodes> claims;
  std::vector<MergeTree> made;
  together(ranks, [&] {
    maker.emplace(HostExecutionSpace(), gathered.order(), gathered.graph(), trees);
    made = maker->make_nodes(options.threshold == 0 ? nullptr : &threshold, claims);
  });
  std::array<Mirrored<Id>, 2> places;
  for (const Side side : {below, above}) {
    if (!maker->uses(side)) continue;
    Array<const Id, HostMemory> of_ends;
    together(ranks, [&] {
      const std::vector<Id> extrema = gathered.places_of_extrema(side);
      of_ends = sides[side]->places_of_ends([&](GlobalId id) { return extrema[gathered.place_of(id)]; });
    });
    places[side] = ends_of_vertices(*sides[side]->paths, of_ends);
  }
  std::vector<std::vector<Id>> arcs;
  together(ranks, [&] {
    arcs = in_worker_or_host_space(places[below].on_device() || places[above].on_device(), [&](const auto& space) {
      const VertexClimbs<std::decay_t<decltype(space)>> climbs(space, order, gathered, places, *maker);
      return arcs_of_vertices(space, mesh, climbs.climbs, claims);
    });
  });
  for (std::size_t i = 0; i < made.size(); ++i) set_arcs_on_ranks(mesh, gathered.mesh(), made[i], std::move(arcs[i]));
  return made;
}

}  // namespace gale::detail
