#include <algorithm>
#include <utility>

#include <gale/algorithms/links/link_sweep.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>
#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/base/sort.hpp>
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

/// Leaves of sorted meetings those of vertices where two extrema or more meet, each once.
void keep_meetings_of_several(std::vector<Meeting>& meetings) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < meetings.size();) {
    const std::size_t first = kept;
    const Id vertex = meetings[i].vertex;
    for (; i < meetings.size() && meetings[i].vertex == vertex; ++i) {
      if (kept == first || meetings[kept - 1].other != meetings[i].other) meetings[kept++] = meetings[i];
    }
    if (kept == first + 1) kept = first;
  }
  meetings.resize(kept);
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

template <class Space>
FollowedPaths<MemoryOf<Space>> follow_paths(const Space& space, const SideKeys& keys,
                                            ExtremumGraphSide<MemoryOf<Space>> side) {
  FollowedPaths<MemoryOf<Space>> paths{std::move(side.extrema), std::move(side.meetings), side.next};
  parallel_sort("GALE::sort_extrema", paths.extrema.begin(), paths.extrema.end(), keys);
  const auto places = in_memory<MemoryOf<Space>>(paths.extrema);
  parallel_for("GALE::end_paths", space, places.extent(0),
               EndPath<MemoryOf<Space>, std::decay_t<decltype(places)>>{places, paths.ends});
  jump(space, paths.ends);
  std::vector<Id> others;
  others.reserve(paths.meetings.size());
  for (const Meeting& meeting : paths.meetings) others.push_back(meeting.other);
  others = ends_of(space, paths.ends, others);
  for (std::size_t i = 0; i < others.size(); ++i) paths.meetings[i].other = others[i];
  parallel_sort("GALE::sort_meetings", paths.meetings.begin(), paths.meetings.end(),
                [&](const Meeting& a, const Meeting& b) {
                  return a.vertex == b.vertex ? a.other < b.other : keys(a.vertex, b.vertex);
                });
  keep_meetings_of_several(paths.meetings);
  return paths;
}

#define GALE_INSTANTIATE(Space)                                                              \
  template FollowedPaths<MemoryOf<Space>> follow_paths<Space>(const Space&, const SideKeys&, \
                                                              ExtremumGraphSide<MemoryOf<Space>>)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
