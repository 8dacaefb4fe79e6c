#include <algorithm>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/merge_tree/extremum_graph.hpp>

namespace gale::detail {

std::array<Id, 2> ExtremumFinder::visit(Id vertex, const Row& neighbours, const LinkRow& link) {
  if (neighbours.size() > SmallLink::capacity) return visit_large(vertex, neighbours, link);
  const auto sides = sides_of<std::uint64_t>(keys_, vertex, neighbours);
  const SmallLink bits(neighbours.size(), link);
  const std::uint64_t all =
      neighbours.size() == SmallLink::capacity ? ~std::uint64_t(0) : (std::uint64_t(1) << neighbours.size()) - 1;
  const std::uint64_t on_side[2] = {sides.lower, all & ~sides.lower};
  for (const Side side : {below, above}) {
    if (on_side[side] == 0) {
      extrema[side].push_back(vertex);
    } else if (bits.components(on_side[side]) > 1) {
      bits.for_each_component(on_side[side], [&](int i) { meetings[side].push_back({vertex, neighbours[i]}); });
    }
  }
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

namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

void add_found(const std::vector<ExtremumFinder>& finders, ExtremumGraph<HostMemory>& graph) {
  for (const auto& finder : finders) {
    for (const Side side : {below, above}) {
      append(graph[side].extrema, finder.extrema[side]);
      append(graph[side].meetings, finder.meetings[side]);
    }
  }
}

ExtremumGraph<HostMemory> extremum_graph(Structure& structure, const std::uint64_t* keys, const SweepOptions& options) {
  using Ids = Array<Id, HostMemory>;
  const Id count = structure.mesh().vertices();
  ExtremumGraph<HostMemory> graph;
  for (auto& side : graph) side.next = allocate<Ids>("GALE::next_of_vertices", count);
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

}  // namespace gale::detail
