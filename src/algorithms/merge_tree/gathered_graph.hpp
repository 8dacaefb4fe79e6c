#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

/// A vertex that trees are made of, and the extrema at which its paths end, by side; itself if it is one. On a side
/// that no tree is made of -1, unless it is one.
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
  EntriesByRank<T> sent;
  together(ranks, [&] {
    sent = room_by_rank<T>("GALE::told_to_all",
                           std::vector<std::int64_t>(ranks.size(), static_cast<std::int64_t>(mine.size())));
    for (int rank = 0; rank < ranks.size(); ++rank)
      std::copy(mine.begin(), mine.end(), sent.entries.data() + sent.begin[rank]);
  });
  const EntriesByRank<T> received = exchange_packed(ranks, "GALE::told_by_all", sent);
  return {received.entries.data(), received.entries.data() + received.count()};
}

/// A vertex of this rank, with its key as a side sees it, and an extremum of which a path ends there.
struct JoiningVertex {
  std::uint64_t key;
  Id vertex;
  GlobalId extremum;

  bool operator<(const JoiningVertex& other) const {
    return key != other.key ? key < other.key : extremum < other.extremum;
  }
};

/// Keeps the meetings that join paths to extrema which lower ones of this rank (as the side comes to them) don't: what
/// joins extrema that are joined already makes no node, wherever the others are.
inline void keep_joining(std::vector<JoiningVertex>& meetings) {
  std::sort(meetings.begin(), meetings.end());
  std::unordered_map<GlobalId, GlobalId> joined;
  const auto find = [&](GlobalId extremum) {
    auto at = joined.try_emplace(extremum, extremum).first;
    while (at->second != at->first) at = joined.find(at->second);
    joined[extremum] = at->first;
    return at->first;
  };
  std::vector<JoiningVertex> kept;
  for (std::size_t i = 0, next = 0; i < meetings.size(); i = next) {
    const std::size_t before = kept.size();
    kept.push_back(meetings[i]);
    const GlobalId first = find(meetings[i].extremum);
    for (next = i + 1; next < meetings.size() && meetings[next].vertex == meetings[i].vertex; ++next) {
      const GlobalId other = find(meetings[next].extremum), all = find(first);
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
  /// Follows them where `is_wanted`; else there are extrema alone. Collective.
  SideOnRanks(const VertexOrder& order, MirroredGraphSide side, bool is_wanted)
      : next(std::move(side.next)),
        extrema(std::move(side.extrema)),
        meetings(is_wanted ? std::move(side.meetings) : std::vector<Meeting>()),
        simplices(order, next, extrema) {
    if (!is_wanted) return;
    std::vector<Id> others;
    together(order.mesh().exchange().ranks(), [&] {
      for (const Meeting& meeting : meetings) {
        if (!order.mesh().owned_vertices().has(meeting.other)) others.push_back(meeting.other);
      }
    });
    paths.emplace(simplices, others);
  }

  /// The extrema at which the paths of some vertices end; where paths aren't followed an extremum itself, -1 for
  /// others.
  std::vector<GlobalId> ends_of(const std::vector<Id>& vertices) const {
    std::vector<GlobalId> ends(vertices.size(), -1);
    if (paths) {
      const std::vector<Id> here = paths->ends_of(vertices);
      for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = paths->final_stop(here[i]).id;
      return ends;
    }
    std::vector<Id> sorted = extrema;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (std::binary_search(sorted.begin(), sorted.end(), vertices[i])) ends[i] = simplices.global(vertices[i]);
    }
    return ends;
  }

  /// For each end that paths have on this rank the place of the extremum where they end finally; no_id where nobody has
  /// asked for one: no path of this rank's comes there.
  Array<const Id, HostMemory> places_of_ends(const std::unordered_map<GlobalId, Id>& places) const {
    const auto of_ends = allocate<Array<Id, HostMemory>>("GALE::places_of_ends", paths->ends());
    for (Id end = 0; end < paths->ends(); ++end) {
      const PathStop stop = paths->final_stop(end);
      of_ends(end) = stop.rank == PathStop::critical ? places.at(stop.id) : no_id;
    }
    return of_ends;
  }

  const Mirrored<Id> next;
  const std::vector<Id> extrema;
  const std::vector<Meeting> meetings;
  const PathSimplices simplices;
  std::optional<PathsOnRanks> paths;
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
      std::vector<Id> at, others;
      for (const Meeting& meeting : sides[side]->meetings) {
        at.push_back(meeting.vertex);
        others.push_back(meeting.other);
      }
      const std::vector<std::uint64_t> keys = order.keys_of(at);
      const SideKeys of_side(keys.data(), side);
      const std::vector<GlobalId> extrema = sides[side]->ends_of(others);
      std::vector<JoiningVertex> meetings;
      for (std::size_t i = 0; i < at.size(); ++i) meetings.push_back({of_side[static_cast<Id>(i)], at[i], extrema[i]});
      keep_joining(meetings);
      for (const JoiningVertex& meeting : meetings) {
        told[side].push_back({id_of(meeting.vertex), meeting.extremum});
        all.push_back(meeting.vertex);
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const std::vector<std::uint64_t> values = order.value_keys_of(all);
    const std::array<std::vector<GlobalId>, 2> ends{sides[below]->ends_of(all), sides[above]->ends_of(all)};
    for (std::size_t i = 0; i < all.size(); ++i)
      own.push_back({id_of(all[i]), values[i], {ends[below][i], ends[above][i]}});
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

}  // namespace gale::detail
