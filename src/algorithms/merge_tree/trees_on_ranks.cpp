#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/merge_tree/assemble.hpp>
#include <gale/algorithms/merge_tree/tree_maker.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sorted_keys.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

/// A vertex that trees are made of, and the extrema at which its paths end, by side; itself if it is one.
struct TreeVertex {
  GlobalId id;
  std::uint64_t value;
  std::array<GlobalId, 2> ends;

  bool operator<(const TreeVertex& other) const { return value != other.value ? value < other.value : id < other.id; }
};

/// A vertex and an extremum of one side, of which a path ends there.
struct TreeMeeting {
  GlobalId vertex, extremum;
};

/// What all ranks have, one after the other. Collective.
template <class T>
std::vector<T> of_all(const Ranks& ranks, const std::vector<T>& mine) {
  Dealt<T> sent;
  together(ranks, [&] {
    sent =
        dealt<T>("GALE::told_to_all", std::vector<std::int64_t>(ranks.size(), static_cast<std::int64_t>(mine.size())));
    for (int rank = 0; rank < ranks.size(); ++rank)
      std::copy(mine.begin(), mine.end(), sent.entries.data() + sent.begin[rank]);
  });
  const Dealt<T> received = exchange(ranks, "GALE::told_by_all", sent);
  return {received.entries.data(), received.entries.data() + received.count()};
}

/// Keeps the meetings that join paths to extrema which lower ones of this rank (as the side comes to them) don't: what
/// joins extrema that are joined already makes no node, wherever the others are.
void keep_joining(const SideKeys& keys, std::vector<std::pair<Id, GlobalId>>& meetings) {
  std::sort(meetings.begin(), meetings.end(), [&](const auto& a, const auto& b) {
    return a.first == b.first ? a.second < b.second : keys(a.first, b.first);
  });
  std::unordered_map<GlobalId, GlobalId> joined;
  const auto find = [&](GlobalId extremum) {
    auto at = joined.try_emplace(extremum, extremum).first;
    while (at->second != at->first) at = joined.find(at->second);
    joined[extremum] = at->first;
    return at->first;
  };
  std::vector<std::pair<Id, GlobalId>> kept;
  for (std::size_t i = 0, next = 0; i < meetings.size(); i = next) {
    const std::size_t before = kept.size();
    kept.push_back(meetings[i]);
    const GlobalId first = find(meetings[i].second);
    for (next = i + 1; next < meetings.size() && meetings[next].first == meetings[i].first; ++next) {
      const GlobalId other = find(meetings[next].second), all = find(first);
      if (other == all) continue;
      joined[other] = all;
      kept.push_back(meetings[next]);
    }
    if (kept.size() == before + 1) kept.pop_back();
  }
  meetings = std::move(kept);
}

/// The paths of one side as this rank has them.
struct SideOnRanks {
  SideOnRanks(const VertexOrder& order, MirroredGraphSide side)
      : next(std::move(side.next)),
        extrema(std::move(side.extrema)),
        meetings(std::move(side.meetings)),
        simplices(order, next, extrema),
        paths(simplices) {}

  GlobalId end_of(Id vertex) const { return paths.final_stop(paths.end(vertex)).id; }

  const Mirrored<Id> next;
  const std::vector<Id> extrema;
  const std::vector<Meeting> meetings;
  const PathSimplices simplices;
  const PathsOnRanks paths;
};

/// What is gathered, as a graph on a small mesh.
class GatheredGraph {
 public:
  GatheredGraph(const VertexOrder& order, const std::array<std::unique_ptr<SideOnRanks>, 2>& sides)
      : ranks_(order.mesh().exchange().ranks()) {
    std::vector<TreeVertex> own;
    std::array<std::vector<TreeMeeting>, 2> meetings;
    together(ranks_, [&] { begin(order, sides, own, meetings); });
    std::size_t bytes = own.size() * sizeof(TreeVertex);
    for (const auto& some : meetings) bytes += some.size() * sizeof(TreeMeeting);
    require_room(ranks_, "extrema and where they meet", std::vector<std::int64_t>(ranks_.size(), std::int64_t(bytes)),
                 0);
    vertices = of_all(ranks_, own);
    for (const Side side : {below, above}) meetings_[side] = of_all(ranks_, meetings[side]);
    together(ranks_, [&] { finish(); });
  }

  /// The graph, whose vertices are places by ascending id.
  ExtremumGraph<HostMemory> graph() const {
    ExtremumGraph<HostMemory> small;
    const auto count = static_cast<Id>(ids_.extent(0));
    for (const Side side : {below, above}) {
      small[side].next = allocate<Array<Id, HostMemory>>("GALE::next_of_gathered", count);
      for (const TreeVertex& vertex : vertices) {
        const Id at = index_.find(vertex.id), end = index_.find(vertex.ends[side]);
        small[side].next(at) = end == at ? no_id : end;
        if (end == at) small[side].extrema.push_back(at);
      }
      for (const TreeMeeting& meeting : meetings_[side])
        small[side].meetings.push_back({index_.find(meeting.vertex), index_.find(meeting.extremum)});
    }
    return small;
  }

  const Mesh& mesh() const { return *mesh_; }
  const VertexOrder& order() const { return *order_; }

  /// The places of extrema as a side comes to them, by id.
  std::unordered_map<GlobalId, Id> places_of_extrema(Side side) const {
    std::unordered_map<GlobalId, Id> places;
    const auto add = [&](const TreeVertex& vertex) {
      if (vertex.ends[side] == vertex.id) places.try_emplace(vertex.id, static_cast<Id>(places.size()));
    };
    if (side == below) {
      std::for_each(vertices.begin(), vertices.end(), add);
    } else {
      std::for_each(vertices.rbegin(), vertices.rend(), add);
    }
    return places;
  }

  std::vector<TreeVertex> vertices;  ///< in the order

 private:
  static void begin(const VertexOrder& order, const std::array<std::unique_ptr<SideOnRanks>, 2>& sides,
                    std::vector<TreeVertex>& own, std::array<std::vector<TreeMeeting>, 2>& told) {
    const Mesh& mesh = order.mesh();
    const OtherIds input = mesh.vertices_in_input();
    const auto id_of = [&](Id vertex) { return mesh.vertex_id(input[vertex]); };
    std::vector<Id> all;
    for (const Side side : {below, above}) {
      all.insert(all.end(), sides[side]->extrema.begin(), sides[side]->extrema.end());
      std::vector<std::pair<Id, GlobalId>> meetings;
      for (const Meeting& meeting : sides[side]->meetings)
        meetings.emplace_back(meeting.vertex, sides[side]->end_of(meeting.other));
      keep_joining(SideKeys(order.keys(), side), meetings);
      for (const auto& [vertex, extremum] : meetings) {
        told[side].push_back({id_of(vertex), extremum});
        all.push_back(vertex);
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const Id vertex : all) {
      own.push_back(
          {id_of(vertex), order.value_key(vertex), {sides[below]->end_of(vertex), sides[above]->end_of(vertex)}});
    }
  }

  void finish() {
    std::sort(vertices.begin(), vertices.end());
    ids_ = allocate<GlobalIds>("GALE::gathered_ids", vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) ids_(i) = vertices[i].id;
    std::sort(ids_.data(), ids_.data() + ids_.extent(0));
    index_ = GlobalIndex(ids_);
    mesh_ = excerpt_mesh<4>(ids_, GlobalIds(), CellCorners<4, Id, HostMemory>());
    std::vector<std::uint64_t> values(vertices.size());
    for (const TreeVertex& vertex : vertices) values[index_.find(vertex.id)] = vertex.value;
    order_ = excerpt_order(*mesh_, [&](Id v) { return values[v]; });
  }

  const Ranks& ranks_;
  std::array<std::vector<TreeMeeting>, 2> meetings_;
  GlobalIds ids_;
  GlobalIndex index_;
  std::optional<Mesh> mesh_;
  std::optional<VertexOrder> order_;
};

/// The way of this rank's vertices to their nodes.
class VertexClimbs {
 public:
  VertexClimbs(const VertexOrder& order, const GatheredGraph& gathered,
               const std::array<std::unique_ptr<SideOnRanks>, 2>& sides, const TreeMaker<HostExecutionSpace>& maker) {
    const Mesh& mesh = order.mesh();
    const Ranks& ranks = mesh.exchange().ranks();
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
        find_keys(order, gathered, side);
        climbs[side].keys = SideKeys(keys_[side].data(), side);
      });
    }
  }

  std::array<SideClimb<HostMemory>, 2> climbs;

 private:
  void find_ends(const Mesh& mesh, const SideOnRanks& side, const std::unordered_map<GlobalId, Id>& places) {
    std::vector<Id> place_of_end;
    for (Id end = 0; end < side.paths.ends(); ++end) place_of_end.push_back(places.at(side.paths.final_stop(end).id));
    if (by_input_.extent(0) == 0) by_input_ = allocate<Array<Id, HostMemory>>("GALE::ends_by_input", mesh.vertices());
    const OtherIds input = mesh.vertices_in_input();
    const Interval owned = mesh.owned_vertices();
    parallel_for("GALE::ends_by_input", HostExecutionSpace(), owned.size(), [&](Offset i) {
      const Id v = owned.first + static_cast<Id>(i);
      by_input_(input[v]) = end_at(place_of_end[side.paths.end(v)]);
    });
  }

  /// Keys of all that this rank holds that compare with those of what was gathered: the place of the last of these that
  /// isn't above, or of the first that isn't below.
  void find_keys(const VertexOrder& order, const GatheredGraph& gathered, Side side) {
    const Mesh& mesh = order.mesh();
    const auto& all = gathered.vertices;
    const std::uint64_t* const small = gathered.order().keys();
    // Keys of an excerpt's order ascend with its vertices: those of places are what trees compare.
    std::vector<std::uint64_t> sorted(small, small + gathered.mesh().vertices());
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint64_t> values;
    for (const TreeVertex& vertex : all) values.push_back(vertex.value);
    const SortedKeys near(std::move(values));
    const OtherIds input = mesh.vertices_in_input();
    keys_[side] = allocate<Array<std::uint64_t, HostMemory>>("GALE::keys_among_gathered", mesh.vertices());
    parallel_for("GALE::keys_among_gathered", HostExecutionSpace(), mesh.vertices(), [&](Offset v) {
      const TreeVertex here{mesh.vertex_id(input[static_cast<Id>(v)]), order.value_key(static_cast<Id>(v)), {}};
      const auto range = near.around(here.value);
      const auto first = std::lower_bound(all.begin() + range.first, all.begin() + range.last, here) - all.begin();
      const bool is_one = first < static_cast<std::ptrdiff_t>(all.size()) && all[first].id == here.id;
      const std::ptrdiff_t place = is_one || side == above ? first : first - 1;
      keys_[side](v) = place < 0                                         ? 0
                       : place < static_cast<std::ptrdiff_t>(all.size()) ? sorted[place]
                                                                         : ~std::uint64_t(0);
    });
  }

  Array<Id, HostMemory> by_input_;
  std::array<Array<std::uint64_t, HostMemory>, 2> keys_;
};

/// Gives a tree the arcs of what this rank holds, and counts those of all. Collective.
void set_arcs_on_ranks(const Mesh& mesh, const Mesh& excerpt, MergeTree& tree, std::vector<Id> arc_of) {
  const Ranks& ranks = mesh.exchange().ranks();
  const auto node = [&](Id i) { return mesh.vertex_of(excerpt.vertex_id(tree.vertices[i])); };
  std::vector<std::int64_t> sizes;
  together(ranks, [&] {
    for (std::size_t i = 0; i < tree.vertices.size(); ++i) {
      const Id here = node(static_cast<Id>(i));
      if (here != no_id) arc_of[here] = no_id;
    }
    const OtherIds input = mesh.vertices_in_input();
    const Id first = mesh.owned_vertices().first;
    const std::vector<Id> mine = sizes_of(tree.arcs.size(), mesh.owned_vertices().size(),
                                          [&](Offset i) { return arc_of[input[first + static_cast<Id>(i)]]; });
    sizes.assign(mine.begin(), mine.end());
    require_ids("arcs of trees", static_cast<Offset>(sizes.size()));
  });
  ranks.sum(sizes.data(), static_cast<int>(sizes.size()));
  together(ranks, [&] {
    for (std::size_t i = 0; i < tree.arcs.size(); ++i) {
      require_ids("vertices on an arc", sizes[i]);
      tree.arcs[i].size = static_cast<Id>(sizes[i]);
      for (const Id end : {tree.arcs[i].lower, tree.arcs[i].upper}) {
        const Id here = node(end);
        if (here != no_id) arc_of[here] = static_cast<Id>(i);
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
  for (const Side side : {below, above}) sides[side] = std::make_unique<SideOnRanks>(order, std::move(graph[side]));
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
  const VertexClimbs climbs(order, gathered, sides, *maker);
  std::vector<std::vector<Id>> arcs;
  together(ranks, [&] { arcs = arcs_of_vertices(HostExecutionSpace(), mesh, climbs.climbs, claims); });
  for (std::size_t i = 0; i < made.size(); ++i) set_arcs_on_ranks(mesh, gathered.mesh(), made[i], std::move(arcs[i]));
  return made;
}

}  // namespace gale::detail
