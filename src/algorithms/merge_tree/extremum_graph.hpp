#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/merge_tree/side_keys.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// A vertex where components of what is below (above) it may meet, and a vertex of one of them. Once paths were
/// followed, the place of that one's extremum.
struct Meeting {
  Id vertex;
  Id other;
};

/// What one side of an order knows of each vertex by its neighbours. All are GALE's vertices.
template <class Memory>
struct ExtremumGraphSide {
  Array<Id, Memory> next;         ///< of each vertex the neighbour that this side comes to first; -1 if that is itself
  std::vector<Id> extrema;        ///< vertices without `next`, in no order
  std::vector<Meeting> meetings;  ///< of each vertex that has several components of neighbours, one each; in no order
};

template <class Memory>
using ExtremumGraph = std::array<ExtremumGraphSide<Memory>, 2>;

/// What a vertex's neighbours say of it, on both sides.
template <class Word>
struct Sides {
  Word lower = 0;               ///< a bit for each lower neighbour, in VV order
  Id next[2] = {no_id, no_id};  ///< the lowest one, and the highest one
};

template <class Word>
KOKKOS_FORCEINLINE_FUNCTION Sides<Word> sides_of(const std::uint64_t* keys, Id vertex, const Row& neighbours) {
  const std::uint64_t own = keys[vertex];
  std::uint64_t least = own, greatest = own;
  Sides<Word> sides;
  for (Id i = 0; i < neighbours.size(); ++i) {
    const std::uint64_t key = keys[neighbours[i]];
    sides.lower |= Word(key < own) << i;
    if (key < least) {
      least = key;
      sides.next[below] = neighbours[i];
    }
    if (key > greatest) {
      greatest = key;
      sides.next[above] = neighbours[i];
    }
  }
  return sides;
}

/// Tells of a component of a vertex's neighbours, by one of these.
template <class Found>
struct AddMeeting {
  Found& found;
  Side side;
  Id vertex;
  const Row& neighbours;

  GALE_CALLS_ANY
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i) const { found.add_meeting(side, {vertex, neighbours[i]}); }
};

/// Visits a vertex whose link lies in bits: returns its sides, and tells `found` what else there is to say of it.
GALE_CALLS_ANY
template <class Link, class Found>
KOKKOS_FORCEINLINE_FUNCTION Sides<typename Link::Word> visit_link(const std::uint64_t* keys, Id vertex,
                                                                  const Row& neighbours, const Link& link,
                                                                  Found& found) {
  using Word = typename Link::Word;
  const Sides<Word> sides = sides_of<Word>(keys, vertex, neighbours);
  const Word all = neighbours.size() == Link::capacity ? ~Word(0) : (Word(1) << neighbours.size()) - 1;
  for (int i = below; i <= above; ++i) {
    const auto side = static_cast<Side>(i);
    const Word on_side = side == below ? sides.lower : all & ~sides.lower;
    if (on_side == 0) {
      found.add_extremum(side, vertex);
    } else if (link.components(on_side) > 1) {
      link.for_each_component(on_side, AddMeeting<Found>{found, side, vertex, neighbours});
    }
  }
  return sides;
}

/// Finds the graph of single vertices, one after the other. One serves one thread.
class ExtremumFinder {
 public:
  explicit ExtremumFinder(const std::uint64_t* keys) : keys_(keys) {}

  /// Visits a vertex: returns its next vertices, and keeps what else there is to say of it.
  std::array<Id, 2> visit(Id vertex, const Row& neighbours, const LinkRow& link);

  void add_extremum(Side side, Id vertex) { extrema[side].push_back(vertex); }
  void add_meeting(Side side, const Meeting& meeting) { meetings[side].push_back(meeting); }

  std::array<std::vector<Id>, 2> extrema;
  std::array<std::vector<Meeting>, 2> meetings;

 private:
  std::array<Id, 2> visit_large(Id vertex, const Row& neighbours, const LinkRow& link);

  const std::uint64_t* keys_;
  LargeLink large_;
};

/// Adds the extrema and meetings that they kept.
template <class Memory>
void add_found(const std::vector<ExtremumFinder>& finders, ExtremumGraph<Memory>& graph) {
  const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
  for (const auto& finder : finders) {
    for (const Side side : {below, above}) {
      append(graph[side].extrema, finder.extrema[side]);
      append(graph[side].meetings, finder.meetings[side]);
    }
  }
}

/// Extrema and meetings, by side, as lanes find them.
struct ExtremaOfLanes {
  DeviceList<Id> extrema[2];
  DeviceList<Meeting> meetings[2];

  explicit ExtremaOfLanes(Offset room)
      : extrema{{"GALE::extrema", room}, {"GALE::extrema", room}},
        meetings{{"GALE::meetings", room}, {"GALE::meetings", room}} {}

  KOKKOS_FORCEINLINE_FUNCTION void add_extremum(Side side, Id vertex) const { extrema[side].add(vertex); }
  KOKKOS_FORCEINLINE_FUNCTION void add_meeting(Side side, const Meeting& meeting) const { meetings[side].add(meeting); }

  /// Gives them to a graph if there was room for all; if not, `room` becomes what there must be.
  template <class Memory>
  bool give(ExtremumGraph<Memory>& graph, Offset& room) const {
    const Offset most =
        std::max({extrema[below].count(), extrema[above].count(), meetings[below].count(), meetings[above].count()});
    if (most > std::exchange(room, most)) return false;
    for (const Side side : {below, above}) {
      graph[side].extrema = extrema[side].to_host();
      graph[side].meetings = meetings[side].to_host();
    }
    return true;
  }
};

/// One of which nothing is known yet; the next vertices of those that a rank doesn't own are elsewhere.
template <class Space>
ExtremumGraph<MemoryOf<Space>> unknown_graph(const Space& space, const Mesh& mesh) {
  ExtremumGraph<MemoryOf<Space>> graph;
  for (auto& side : graph) {
    side.next = allocate<Array<Id, MemoryOf<Space>>>("GALE::next_of_vertices", mesh.vertices());
    if (mesh.owned_vertices().size() < mesh.vertices())
      fill("GALE::next_of_ghosts", space, side.next, DiscreteGradient::elsewhere);
  }
  return graph;
}

/// Finds it in a sweep of consumers on the host.
ExtremumGraph<HostMemory> extremum_graph(Structure& structure, const std::uint64_t* keys, const SweepOptions& options);

/// Finds it by kernels where the relations are made; vertices of more than 64 neighbours on the host.
ExtremumGraph<MemoryOf<WorkerSpace>> extremum_graph(const WorkerSpace& space, const VertexOrder& order,
                                                    const DeviceSweepOptions& options);

/// Finds that of a whole grid from the keys alone: no rows are made.
template <class Space>
ExtremumGraph<MemoryOf<Space>> extremum_graph_of_grid(const Space& space, const VertexOrder& order,
                                                      const SweepOptions& options);

}  // namespace gale::detail
