#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/grid_lanes.hpp>
#include <gale/algorithms/gradient/pair_fans.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

// A lane a vertex. Its row of edges lies in one stretch of memory of which each team reserves what its segment takes;
// on a triangle mesh there are no such rows (PairFans). Grids need no teams (grid_lanes.hpp).
// What a sweep finds is complete if no list was too short: else it is made again with lists that suffice.

namespace gale {

namespace detail {

/// Pairs the lower stars of a segment's vertices.
struct PairStars {
  const std::uint64_t* keys;
  LaneSink sink;
  Id* words;
  Offset capacity;      ///< of words
  Offset* used;         ///< words reserved; above `capacity` it says what there should have been
  Offset* pairs_begin;  ///< of each vertex
  HandedStars large;    ///< of more than one word of cells
  int scratch_rows;     ///< that a team has scratch memory for

  struct Shared {
    Offset begin;
  };

  KOKKOS_FUNCTION static std::size_t scratch_bytes(int rows) {
    return sizeof(Shared) + (2 * std::size_t(rows) + 1) * sizeof(Id);
  }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<MemoryOfSweep<WorkerSpace>>& segment) const {
    char* const scratch = team::scratch<0>(team, scratch_bytes(scratch_rows));
    Shared& shared = *reinterpret_cast<Shared*>(scratch);
    Id* const begin = reinterpret_cast<Id*>(scratch + sizeof(Shared));
    const Rows neighbours = segment[Relation::VV], tetrahedra = segment[Relation::VT];
    const LinkRows links = segment.links();
    for (Id from = 0; from < neighbours.count; from += scratch_rows) {
      const Id rows = neighbours.count - from < scratch_rows ? neighbours.count - from : scratch_rows;
      const Id first = neighbours.first + from;
      const auto star_of = [&](Id v) { return VertexStar{v, neighbours[v], tetrahedra[v], links[v]}; };
      team::for_all(team, rows, [&](int i) { begin[i] = words_for(neighbours[first + i], first + i); });
      team::exclusive_scan(team, rows, begin);
      team::once(team, [&] {
        const Offset at = team::add(team, used, Offset(begin[rows]));
        shared.begin = at + begin[rows] <= capacity ? at : -1;
      });
      team::barrier(team);
      if (shared.begin >= 0) {
        Id* const by_size = begin + scratch_rows + 1;
        sort_by_size(team, rows, begin, by_size);
        team::for_all(team, rows, [&](int k) {
          const Id i = by_size[k];
          const Offset at = shared.begin + begin[i];
          const VertexStar star = star_of(first + i);
          pairs_begin[first + i] = at;
          if (!sink.pair<1>(keys, star, words + at)) large.add(star);
        });
      }
      team::barrier(team);
    }
  }

 private:
  /// The rows by their lengths, the longest first, so that lanes of a warp have stars of about one size.
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION static void sort_by_size(const Team& team, Id rows, const Id* begin, Id* by_size) {
    team::for_all(team, rows, [&](int i) {
      const Id size = begin[i + 1] - begin[i];
      Id before = 0;
      for (Id k = 0; k < rows; ++k) {
        const Id other = begin[k + 1] - begin[k];
        before += other > size || (other == size && k < i);
      }
      by_size[before] = i;
    });
    team::barrier(team);
  }

  /// What the row of a vertex takes.
  KOKKOS_FORCEINLINE_FUNCTION Id words_for(const Row& neighbours, Id v) const {
    const std::uint64_t key = keys[v];
    Id lower = 0;
    for (const Id neighbour : neighbours) lower += keys[neighbour] < key;
    return static_cast<Id>(EdgePairRow::words_for(lower));
  }
};

/// Pairs the stars that PairStars hands on; those of more than two words are handed on again.
struct PairLargeStars {
  const std::uint64_t* keys;
  LaneSink sink;
  Id* words;
  const Offset* pairs_begin;
  HandedStars large;
  DeviceList<Offset> outgrown;  ///< places in `large`

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const VertexStar star = large[i];
    if (!sink.pair<2>(keys, star, words + pairs_begin[star.vertex])) outgrown.add(i);
  }
};

}  // namespace detail

namespace {

using Memory = detail::MemoryOfSweep<WorkerSpace>;
using detail::DeviceList;

bool is_grid_of_tetrahedra(const Mesh& mesh) { return mesh.grid() != nullptr && mesh.dimension() == 3; }

template <class>
using Capacity = Offset;

/// How much room a sweep has for what it finds.
struct Room {
  Offset words, large, large_words, left;  ///< the last of grids, the others of other meshes
  detail::FoundSimplices<Capacity> critical;

  /// What a mesh that has few triangles on its surface takes, of a field that isn't noise.
  explicit Room(const Mesh& mesh) {
    const double all = mesh.vertices();
    const double lower_edges = 1.08 * (all + mesh.cells());
    const bool has_rows = mesh.dimension() == 3;
    words = has_rows ? static_cast<Offset>(1.25 * lower_edges + 1.75 * all) + 1024 : 0;
    large = static_cast<Offset>(all / 16) + 1024;
    large_words = 64 * large;
    critical = {large, large, has_rows ? large : 0, large, 2 * large};
    left = 0;
    if (mesh.grid() == nullptr) return;
    words = large = large_words = 0;
    if (has_rows) left = mesh.vertices() / 8 + 4096;
  }
};

/// The last stars of each batch take their time: so there are few batches, large ones.
constexpr std::size_t usual_memory = std::size_t(384) << 20;
constexpr int usual_batches = 2;

/// One sweep.
class Attempt {
 public:
  Attempt(const WorkerSpace& space, const VertexOrder& order, const Room& room, const DeviceSweepOptions& options)
      : mesh_(order.mesh()),
        vertex_successor_(allocate<Array<Id, Memory>>("GALE::vertex_successor", mesh_.vertices())),
        cell_successor_(allocate<Array<Id, Memory>>("GALE::cell_successor", mesh_.cells())),
        words_(allocate<Array<Id, Memory>>("GALE::edge_pairs", room.words)),
        pairs_begin_(
            allocate<Array<Offset, Memory>>("GALE::edge_pairs_begin", mesh_.dimension() == 3 ? mesh_.vertices() : 0)),
        used_("GALE::edge_pairs_used", 1),
        large_(room.large, room.large_words),
        outgrown_("GALE::outgrown", 0),
        left_("GALE::left_stars", room.left),
        sink_{vertex_successor_.data(),
              cell_successor_.data(),
              {{"GALE::critical_vertices", room.critical.vertices},
               {"GALE::critical_edges", room.critical.edges},
               {"GALE::critical_triangles", room.critical.triangles},
               {"GALE::critical_cells", room.critical.cells},
               {"GALE::critical_stars", room.critical.stars}}} {
    detail::mark_ghosts(space, mesh_, vertex_successor_, cell_successor_);
    DeviceSweepOptions sized = options;
    if (have_device && options.memory == 0) sized.memory = usual_memory;
    if (have_device && options.batches == 0) sized.batches = usual_batches;
    if (is_grid_of_tetrahedra(mesh_)) {
      pair_grid(space, order);
    } else if (mesh_.grid() != nullptr) {
      pair_grid_fans(space, order);
    } else if (mesh_.dimension() == 3) {
      pair_stars(space, order, room, sized);
    } else {
      pair_fans(space, order, sized);
    }
  }

  /// Was there room for all? If not, `room` becomes what there must be.
  bool fitted(Room& room) const {
    bool is_enough = !large_.overflowed(room.large, room.large_words);
    const auto raise = [&](Offset& to, Offset count) {
      if (count <= to) return;
      to = count;
      is_enough = false;
    };
    for_each_list(room.critical, sink_.found, [&](Offset& to, const auto& list) { raise(to, list.count()); });
    raise(room.left, left_.count());
    if (words_used_ <= room.words || is_grid_of_tetrahedra(mesh_)) return is_enough;
    raise(room.words, words_used_);
    // Segments without room for their rows have found nothing: there may be more of everything.
    for (Offset* const list : {&room.critical.edges, &room.critical.triangles, &room.critical.cells})
      raise(*list, mesh_.vertices());
    return false;
  }

  detail::DeviceGradient found() const {
    detail::DeviceGradient found;
    found.vertex_successor = vertex_successor_;
    found.cell_successor = cell_successor_;
    found.pair_words = Kokkos::subview(words_, std::make_pair(Offset(0), words_used_));
    found.pairs_begin = pairs_begin_;
    for_each_list(found.critical, sink_.found, [](auto& there, const auto& list) { there = list.to_host(); });
    return found;
  }

  /// Stars that are still unpaired: places among the large ones.
  std::vector<Offset> outgrown() const {
    if (mesh_.dimension() == 3) return outgrown_.to_host();
    std::vector<Offset> all(large_.count());
    std::iota(all.begin(), all.end(), Offset(0));
    return all;
  }
  const detail::HandedStars& large() const { return large_; }

 private:
  void pair_stars(const WorkerSpace& space, const VertexOrder& order, const Room& room,
                  const DeviceSweepOptions& options) {
    if (mesh_.owned_vertices().size() < mesh_.vertices()) Kokkos::deep_copy(space, pairs_begin_, Offset(0));
    const auto rows = static_cast<int>(std::min(1024.0, 1.3 * mesh_.vertices() / mesh_.segments() + 32));
    const detail::PairStars pair{order.keys_in<Memory>().data(),
                                 sink_,
                                 words_.data(),
                                 room.words,
                                 used_.data(),
                                 pairs_begin_.data(),
                                 large_,
                                 rows};
    DeviceSweepOptions with_scratch = options;
    with_scratch.team_scratch = detail::PairStars::scratch_bytes(rows) + 16;
    for_each_segment(space, mesh_, discrete_gradient_relations, pair, with_scratch);
    Kokkos::deep_copy(words_used_, Kokkos::subview(used_, 0));
    const Offset count = std::min(large_.count(), room.large);
    outgrown_ = {"GALE::outgrown", count};
    if (words_used_ > room.words) return;
    Kokkos::parallel_for(
        "GALE::pair_large_stars", detail::device_range(space, count),
        detail::PairLargeStars{pair.keys, sink_, words_.data(), pairs_begin_.data(), large_, outgrown_});
    space.fence();
  }

  /// Finds where rows begin first: then they take what they need.
  void pair_grid(const WorkerSpace& space, const VertexOrder& order) {
    const detail::StarKind* const kinds = mesh_.grid()->kinds_in<HostMemory>();
    const auto whole = allocate<Array<detail::WholeStar, HostMemory>>("GALE::whole_star", 1);
    whole(0) = detail::WholeStar(kinds[detail::grid_kinds - 1]);
    const Array<const detail::WholeStar, Memory> whole_here =
        in_memory<Memory>(Array<const detail::WholeStar, HostMemory>(whole));
    detail::PairGridStars pair{mesh_.grid()->in<Memory>(),
                               mesh_.grid()->kinds_in<Memory>(),
                               whole_here.data(),
                               order.keys_in<Memory>().data(),
                               mesh_.owned_vertices(),
                               sink_,
                               nullptr,
                               nullptr,
                               left_};
    pairs_begin_ = allocate<Array<Offset, Memory>>("GALE::edge_pairs_begin", mesh_.vertices() + Offset(1));
    // A scan would count twice on a device.
    parallel_for("GALE::count_edge_pairs", space, mesh_.vertices(), detail::CountGridWords{pair, pairs_begin_.data()});
    words_used_ = exclusive_scan("GALE::edge_pairs_begin", space, mesh_.vertices(), pairs_begin_, pairs_begin_);
    words_ = allocate<Array<Id, Memory>>("GALE::edge_pairs", words_used_);
    pairs_begin_ = Kokkos::subview(pairs_begin_, std::make_pair(Offset(0), Offset(mesh_.vertices())));
    pair.words = words_.data();
    pair.pairs_begin = pairs_begin_.data();
    parallel_for("GALE::pair_on_grid", space, pair.owned.size(), pair);
    if (!left_.overflowed()) {
      parallel_for("GALE::pair_rest_of_grid", space, left_.count(), detail::PairOtherGridStars{pair});
      space.fence();
    }
  }

  void pair_grid_fans(const WorkerSpace& space, const VertexOrder& order) {
    const detail::PairGridFans pair{mesh_.grid()->in<Memory>(), mesh_.grid()->kinds_in<Memory>(),
                                    order.keys_in<Memory>().data(), mesh_.owned_vertices(), sink_};
    parallel_for("GALE::pair_on_grid", space, pair.owned.size(), pair);
    space.fence();
  }

  void pair_fans(const WorkerSpace& space, const VertexOrder& order, const DeviceSweepOptions& options) {
    const detail::PairFans pair{order.keys_in<Memory>().data(), sink_, large_};
    for_each_segment(space, mesh_, discrete_gradient_relations_of(2), pair, options);
  }

  Mesh mesh_;
  Array<Id, Memory> vertex_successor_, cell_successor_, words_;
  Array<Offset, Memory> pairs_begin_, used_;
  detail::HandedStars large_;
  DeviceList<Offset> outgrown_;
  DeviceList<Id> left_;
  detail::LaneSink sink_;
  Offset words_used_ = 0;
};

/// Pairs the stars that lanes can't hold.
std::shared_ptr<detail::GradientStore> complete_on_host(const VertexOrder& order, const Attempt& attempt,
                                                        const std::vector<Offset>& outgrown) {
  const auto store = detail::GradientStore::on_host(order, attempt.found(), host_threads());
  const detail::HandedStars::OnHost stars = attempt.large().to_host();
  std::vector<std::unique_ptr<detail::GradientSweep>> sweeps(host_threads());
  in_turns(static_cast<int>(sweeps.size()), static_cast<Offset>(outgrown.size()), [&](int thread, Offset i) {
    if (!sweeps[thread]) sweeps[thread] = std::make_unique<detail::GradientSweep>(*store, thread);
    sweeps[thread]->pair(stars[outgrown[i]]);
  });
  store->finish();
  return store;
}

std::shared_ptr<detail::GradientStore> find_by_kernels(const WorkerSpace& space, const VertexOrder& order,
                                                       const DeviceSweepOptions& options) {
  Room room(order.mesh());
  auto attempt = std::make_unique<Attempt>(space, order, room, options);
  while (!attempt->fitted(room)) {
    attempt.reset();
    attempt = std::make_unique<Attempt>(space, order, room, options);
  }
  const std::vector<Offset> outgrown = attempt->outgrown();
  if (!outgrown.empty()) return complete_on_host(order, *attempt, outgrown);
  return std::make_shared<detail::GradientStore>(order, attempt->found());
}

}  // namespace

DiscreteGradient find_discrete_gradient(const WorkerSpace& space, const VertexOrder& order,
                                        const DeviceSweepOptions& options) {
  std::shared_ptr<detail::GradientStore> store;
  detail::together(order.mesh().exchange().ranks(), [&] { store = find_by_kernels(space, order, options); });
  store->share_counts();
  return DiscreteGradient(store);
}

}  // namespace gale
