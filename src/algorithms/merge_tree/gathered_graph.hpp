#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/merge_tree/joined_extrema.hpp>
#include <gale/algorithms/merge_tree/tree_maker.hpp>
#include <gale/algorithms/merge_tree/trees_on_ranks.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/global_index.hpp>
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
    GlobalIds names;
    together(order.mesh().exchange().ranks(), [&] {
      names = tabulated<GlobalId>("GALE::extremum_ids", static_cast<Offset>(extrema.size()),
                                  [&](Offset i) { return simplices.global(extrema[i]); });
      const Interval owned = order.mesh().owned_vertices();
      others = collected<Id>("GALE::meetings_elsewhere", meetings.size(), [&](Offset i, const auto& add) {
        if (!owned.has(meetings[i].other)) add(meetings[i].other);
      });
    });
    paths.emplace(simplices, names, others);
  }

  /// The extrema at which the paths of some vertices end; where paths aren't followed an extremum itself, -1 for
  /// others.
  std::vector<GlobalId> ends_of(const std::vector<Id>& vertices) const {
    std::vector<GlobalId> ends(vertices.size(), -1);
    if (paths) {
      const std::vector<Id> here = paths->ends_of(vertices);
      parallel_for("GALE::ends_on_side", HostExecutionSpace(), ends.size(),
                   [&](Offset i) { ends[i] = paths->final_name(here[i]); });
      return ends;
    }
    std::vector<Id> sorted = extrema;
    parallel_sort("GALE::sort_extrema", sorted.begin(), sorted.end());
    parallel_for("GALE::ends_on_side", HostExecutionSpace(), ends.size(), [&](Offset i) {
      if (std::binary_search(sorted.begin(), sorted.end(), vertices[i])) ends[i] = simplices.global(vertices[i]);
    });
    return ends;
  }

  /// For each end that paths have on this rank place_of(extremum) of the one where they end finally; no_id where nobody
  /// has asked for one: no path of this rank's comes there.
  template <class PlaceOf>
  Array<const Id, HostMemory> places_of_ends(const PlaceOf& place_of) const {
    return tabulated<Id>("GALE::places_of_ends", paths->ends(), [&](Offset end) {
      const GlobalId extremum = paths->final_name(static_cast<Id>(end));
      return extremum >= 0 ? place_of(extremum) : no_id;
    });
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
    std::tie(vertices, meetings_[below], meetings_[above]) =
        lists_of_all(ranks_, "GALE::told_to_all", own, meetings[below], meetings[above]);
    together(ranks_, [&] { finish(); });
  }

  /// What trees are made of: the graph's vertices are places in the order, those of mesh() the input's.
  TreeParts<HostMemory> parts() const {
    TreeParts<HostMemory> parts;
    const Offset count = static_cast<Offset>(vertices.size());
    parts.compared.vertices.resize(count);
    parts.compared.keys.resize(count);
    parallel_for("GALE::gathered_keys", HostExecutionSpace(), count, [&](Offset i) {
      parts.compared.vertices[i] = static_cast<Id>(i);
      parts.compared.keys[i] = key_of(i);
    });
    parts.input = vertex_of_;
    parts.keys = parts.compared.keys.data();
    for (const Side side : {below, above}) {
      ExtremumGraphSide<HostMemory>& of = parts.graph[side];
      of.next = tabulated<Id>("GALE::next_of_gathered", count, [&](Offset i) {
        return is_extremum(i, side) ? no_id : place_of(vertices[i].ends[side]);
      });
      of.extrema = collected<Id>("GALE::gathered_extrema", count, [&](Offset i, const auto& add) {
        if (is_extremum(i, side)) add(static_cast<Id>(i));
      });
      const std::vector<TreeMeeting>& meetings = meetings_[side];
      of.meetings.resize(meetings.size());
      parallel_for("GALE::gathered_meetings", HostExecutionSpace(), meetings.size(), [&](Offset i) {
        of.meetings[i] = {place_of(meetings[i].vertex), place_of(meetings[i].extremum)};
      });
    }
    return parts;
  }

  /// The key of the vertex at a place: what is below all has 0.
  static KOKKOS_FUNCTION std::uint64_t key_of(std::int64_t place) { return static_cast<std::uint64_t>(place + 1); }

  const Mesh& mesh() const { return *mesh_; }

  /// The place of a vertex in the order; no_id if it isn't one of them.
  Id place_of(GlobalId id) const {
    const Id vertex = index_.find(id);
    return vertex == no_id ? no_id : in_order_(vertex);
  }

  /// The places of extrema as a side comes to them, by their places among vertices; no_id for others.
  std::vector<Id> places_of_extrema(Side side) const {
    std::vector<Id> places(vertices.size(), no_id);
    Id count = 0;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::size_t i = side == below ? k : vertices.size() - 1 - k;
      if (is_extremum(i, side)) places[i] = count++;
    }
    return places;
  }

  std::vector<TreeVertex> vertices;  ///< in the order

 private:
  bool is_extremum(Offset i, Side side) const { return vertices[i].ends[side] == vertices[i].id; }

  static void begin(const VertexOrder& order, const std::array<std::unique_ptr<SideOnRanks>, 2>& sides,
                    std::vector<TreeVertex>& own, std::array<std::vector<TreeMeeting>, 2>& told) {
    const Mesh& mesh = order.mesh();
    const OtherIds input = mesh.vertices_in_input();
    const auto id_of = [&](Id vertex) { return mesh.vertex_id(input[vertex]); };
    std::vector<Id> all;
    for (const Side side : {below, above}) {
      if (!sides[side]->paths) continue;
      const SideOnRanks& other = *sides[opposite(side)];
      const auto [meetings, lasts] =
          joining(order, *sides[side], side, other.paths ? std::vector<Id>() : other.extrema);
      for (const JoiningVertex& meeting : meetings) {
        told[side].push_back({id_of(meeting.vertex), meeting.extremum});
        all.push_back(meeting.vertex);
      }
      all.insert(all.end(), sides[side]->extrema.begin(), sides[side]->extrema.end());
      all.insert(all.end(), lasts.begin(), lasts.end());
    }
    sort_distinct("GALE::sort_told", all);
    const std::vector<std::uint64_t> values = order.value_keys_of(all);
    const std::array<std::vector<GlobalId>, 2> ends{sides[below]->ends_of(all), sides[above]->ends_of(all)};
    own.resize(all.size());
    parallel_for("GALE::told_vertices", HostExecutionSpace(), all.size(), [&](Offset i) {
      own[i] = {id_of(all[i]), values[i], {ends[below][i], ends[above][i]}};
    });
  }

  /// What is told of a side.
  struct Joining {
    std::vector<JoiningVertex> meetings;  ///< that join what this rank's others don't
    std::vector<Id> lasts;                ///< the last of the others (below) of each of its extrema that it joins
  };

  /// `others` are extrema of the other side where that isn't followed: a tree needs the last in each component.
  static Joining joining(const VertexOrder& order, const SideOnRanks& paths, Side side, const std::vector<Id>& others) {
    const Offset met = static_cast<Offset>(paths.meetings.size()), count = met + static_cast<Offset>(others.size());
    std::vector<Id> at(count), from(count);
    parallel_for("GALE::meetings", HostExecutionSpace(), count, [&](Offset i) {
      at[i] = i < met ? paths.meetings[i].vertex : others[i - met];
      from[i] = i < met ? paths.meetings[i].other : others[i - met];
    });
    const std::vector<std::uint64_t> keys = order.keys_of(at);
    const SideKeys of_side(keys.data(), side);
    const std::vector<GlobalId> extrema = paths.ends_of(from);
    Joining told;
    told.meetings.resize(met);
    parallel_for("GALE::meetings", HostExecutionSpace(), met, [&](Offset i) {
      told.meetings[i] = {of_side[static_cast<Id>(i)], at[i], extrema[i]};
    });
    JoinedExtrema joined(told.meetings);
    HashTable<Id> number;     // of the extremum that stands for others
    std::vector<Id> last_of;  // by these numbers
    for (Id i = static_cast<Id>(met); i < count; ++i) {
      const auto [of_all, is_new] = number.insert(static_cast<std::uint64_t>(joined.of(extrema[i])));
      if (is_new) {
        of_all = static_cast<Id>(last_of.size());
        last_of.push_back(i);
      } else if (of_side(last_of[of_all], i)) {
        last_of[of_all] = i;
      }
    }
    for (const Id last : last_of) told.lasts.push_back(at[last]);
    return told;
  }

  void finish() {
    parallel_sort("GALE::sort_gathered", vertices.begin(), vertices.end());
    const Offset count = static_cast<Offset>(vertices.size());
    const DistinctIds by_id =
        distinct_ids(tabulated<GlobalId>("GALE::gathered_ids", count, [&](Offset i) { return vertices[i].id; }));
    index_ = GlobalIndex(by_id.ids);
    in_order_ = by_id.places;
    vertex_of_.resize(count);
    parallel_for("GALE::gathered_vertices", HostExecutionSpace(), count,
                 [&](Offset vertex) { vertex_of_[in_order_(vertex)] = static_cast<Id>(vertex); });
    mesh_ = excerpt_mesh<4>(by_id.ids, GlobalIds(), CellCorners<4, Id, HostMemory>());
  }

  const Ranks& ranks_;
  std::array<std::vector<TreeMeeting>, 2> meetings_;
  GlobalIndex index_;
  std::optional<Mesh> mesh_;
  Array<const Id, HostMemory>
      in_order_;               ///< of the mesh's vertices, which are by ascending id, the places in the order
  std::vector<Id> vertex_of_;  ///< the mesh's vertex at each place
};

}  // namespace gale::detail
