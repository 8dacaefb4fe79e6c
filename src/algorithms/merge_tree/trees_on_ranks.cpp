#include <algorithm>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/merge_tree/vertex_climbs.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

/// Sets the arcs of nodes in a tree that has those of what this rank holds, and counts on each what all ranks own.
/// Collective.
void set_arcs_on_ranks(const Mesh& mesh, const Mesh& excerpt, MergeTree& tree) {
  const Ranks& ranks = mesh.exchange().ranks();
  std::vector<Id> node;  // by input id; no_id where it isn't here
  std::vector<std::int64_t> sizes;
  std::vector<Id>& arc_of = tree.arc_of;
  together(ranks, [&] {
    node.resize(tree.vertices.size());
    parallel_for("GALE::nodes_here", HostExecutionSpace(), node.size(),
                 [&](Offset i) { node[i] = mesh.vertex_of(excerpt.vertex_id(tree.vertices[i])); });
    for (const MergeArc& arc : tree.arcs) sizes.push_back(arc.size);
    for (const Id vertex : node) {
      const Id arc = vertex == no_id ? no_id : std::exchange(arc_of[vertex], no_id);
      if (arc != no_id) --sizes[arc];
    }
    const auto& ghosts = mesh.exchange().from_owners().slots();
    const auto of_ghosts =
        tabulated<Id>("GALE::arcs_of_ghosts", ghosts.extent(0), [&](Offset i) { return arc_of[ghosts(i)]; });
    const std::vector<Id> of_others = sizes_of_arcs(HostExecutionSpace(), tree.arcs.size(), of_ghosts);
    std::transform(sizes.begin(), sizes.end(), of_others.begin(), sizes.begin(), std::minus<std::int64_t>());
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
      options.threshold, [&](Id vertex) { return known_value(values[vertex], gathered.mesh().vertex_id(vertex)); }};
  std::optional<TreeMaker<HostExecutionSpace>> maker;
  std::vector<ArcsOfNodes> claims;
  std::vector<MergeTree> made;
  together(ranks, [&] {
    maker.emplace(HostExecutionSpace(), gathered.parts(), trees);
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
  together(ranks, [&] {
    in_worker_or_host_space(places[below].on_device() || places[above].on_device(), [&](const auto& space) {
      const VertexClimbs<std::decay_t<decltype(space)>> climbs(space, order, gathered, places, *maker);
      find_arcs_of_vertices(space, mesh, climbs.climbs, claims, made);
    });
  });
  for (MergeTree& tree : made) set_arcs_on_ranks(mesh, gathered.mesh(), tree);
  return made;
}

}  // namespace gale::detail
