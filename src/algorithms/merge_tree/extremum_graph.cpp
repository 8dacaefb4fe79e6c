#include <algorithm>
#include <utility>

#include <gale/algorithms/links/link_sweep.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

std::array<Id, 2> ExtremumFinder::visit(Id vertex, const Row& neighbours, const LinkRow& link) {
  if (neighbours.size() > SmallLink::capacity) return visit_large(vertex, neighbours, link);
  const auto sides = visit_link(keys_, vertex, neighbours, SmallLink(neighbours.size(), link), *this);
  return {sides.next[below], sides.next[above]};
}

std::array<Id, 2> ExtremumFinder::visit_large(Id vertex, const Row& neighbours, const LinkRow& link) {
  std::array<Id, 2> next = {no_id, no_id};
  for (const Side side : {below, above}) {
    const SideKeys keys(keys_, side);
    const Id first = *std::min_element(neighbours.begin(), neighbours.end(), keys);
    if (keys(first, vertex)) {
      next[side] = first;
    } else {
      extrema[side].push_back(vertex);
    }
  }
  const auto is_lower = [&](Id i) { return keys_[neighbours[i]] < keys_[vertex]; };
  large_.build(link);
  const LinkTopology topology = large_.topology(neighbours.size(), is_lower);
  large_.for_each_component(neighbours.size(), [&](Id i) {
    const Side side = is_lower(i) ? below : above;
    if ((side == below ? topology.lower : topology.upper) > 1) meetings[side].push_back({vertex, neighbours[i]});
  });
  return next;
}

ExtremumGraph<HostMemory> extremum_graph(Structure& structure, const std::uint64_t* keys, const SweepOptions& options) {
  ExtremumGraph<HostMemory> graph = unknown_graph(HostExecutionSpace(), structure.mesh());
  Id* const next[2] = {graph[below].next.data(), graph[above].next.data()};
  std::vector<ExtremumFinder> finders(std::max(options.threads, 0), ExtremumFinder(keys));
  structure.for_each_segment(merge_tree_relations, options, [&](int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    for (const Id v : rows.interval(Relation::VV)) {
      const auto found = finders[consumer].visit(v, neighbours[v], links[v]);
      next[below][v] = found[below];
      next[above][v] = found[above];
    }
  });
  add_found(finders, graph);
  return graph;
}

namespace {

/// What a lane does with a vertex.
struct FindExtrema {
  const std::uint64_t* keys;
  Id* next[2];
  ExtremaOfLanes found;

  template <class Link>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(Id v, const Row& row, const Link& link) const {
    const auto sides = visit_link(keys, v, row, link, found);
    next[below][v] = sides.next[below];
    next[above][v] = sides.next[above];
  }
};

/// Has the host visit what lanes handed on.
void add_outgrown(const WorkerSpace& space, const VertexOrder& order, const HandedStars& outgrown,
                  ExtremumGraph<MemoryOf<WorkerSpace>>& graph) {
  const HandedStars::OnHost stars = outgrown.to_host();
  const auto found = allocate<Array<Id, HostMemory>>("GALE::outgrown_next", 2 * stars.size());
  std::vector<ExtremumFinder> finders(host_threads(), ExtremumFinder(order.keys()));
  in_turns(static_cast<int>(finders.size()), stars.size(), [&](int thread, std::int64_t i) {
    const VertexStar star = stars[i];
    const auto next = finders[thread].visit(star.vertex, star.neighbours, star.link);
    found(2 * i) = next[below];
    found(2 * i + 1) = next[above];
  });
  add_found(finders, graph);
  const auto there = on_worker(found);
  Id *const lower = graph[below].next.data(), *const upper = graph[above].next.data();
  parallel_for(
      "GALE::add_outgrown_next", space, stars.size(), KOKKOS_LAMBDA(Offset i) {
        lower[outgrown[i].vertex] = there(2 * i);
        upper[outgrown[i].vertex] = there(2 * i + 1);
      });
  space.fence();
}

}  // namespace

ExtremumGraph<MemoryOf<WorkerSpace>> extremum_graph(const WorkerSpace& space, const VertexOrder& order,
                                                    const DeviceSweepOptions& options) {
  using Memory = MemoryOf<WorkerSpace>;
  const Mesh& mesh = order.mesh();
  ExtremumGraph<Memory> graph = unknown_graph(space, mesh);
  for (Offset room = mesh.vertices() / 16 + 1024;;) {
    const auto sweep = sweep_links(space, mesh, options, [&] {
      return FindExtrema{
          order.keys_in<Memory>().data(), {graph[below].next.data(), graph[above].next.data()}, ExtremaOfLanes(room)};
    });
    if (!sweep.visit.found.give(graph, room)) continue;
    if (sweep.outgrown.count() > 0) add_outgrown(space, order, sweep.outgrown, graph);
    return graph;
  }
}

}  // namespace gale::detail
