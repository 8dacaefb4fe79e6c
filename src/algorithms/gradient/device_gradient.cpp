#include <algorithm>
#include <memory>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/pairing_kernels.hpp>
#include <gale/base/parallel.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

// A lane a vertex. Its row of edges lies in one stretch of memory of which each team reserves what its segment takes.
// What a sweep finds is complete if no list was too short: else it is made again with lists that suffice.

namespace gale {

namespace {

using Memory = detail::MemoryOfSweep<WorkerSpace>;
using detail::DeviceList;

/// How much room a sweep has for what it finds.
struct Room {
  Offset words, vertices, edges, triangles, tetrahedra, stars, large, large_words;

  /// What a mesh that has few triangles on its surface takes, of a field that isn't noise.
  explicit Room(const Mesh& mesh) {
    const double all = mesh.vertices();
    const double lower_edges = 1.08 * (all + mesh.tetrahedra());
    words = static_cast<Offset>(1.25 * lower_edges + 1.75 * all) + 1024;
    vertices = edges = triangles = tetrahedra = static_cast<Offset>(all / 16) + 1024;
    stars = 2 * triangles;
    large = static_cast<Offset>(all / 16) + 1024;
    large_words = 64 * large;
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
        tetrahedron_successor_(allocate<Array<Id, Memory>>("GALE::tetrahedron_successor", mesh_.tetrahedra())),
        words_(allocate<Array<Id, Memory>>("GALE::edge_pairs", room.words)),
        pairs_begin_(allocate<Array<Offset, Memory>>("GALE::edge_pairs_begin", mesh_.vertices())),
        used_("GALE::edge_pairs_used", 1),
        large_(room.large, room.large_words),
        sink_{vertex_successor_.data(),
              tetrahedron_successor_.data(),
              {"GALE::critical_vertices", room.vertices},
              {"GALE::critical_edges", room.edges},
              {"GALE::critical_triangles", room.triangles},
              {"GALE::critical_tetrahedra", room.tetrahedra},
              {"GALE::critical_stars", room.stars}} {
    detail::mark_ghosts(space, mesh_, vertex_successor_, tetrahedron_successor_);
    if (mesh_.owned_vertices() < mesh_.vertices()) Kokkos::deep_copy(space, pairs_begin_, Offset(0));
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
    if (have_device && options.memory == 0) with_scratch.memory = usual_memory;
    if (have_device && options.batches == 0) with_scratch.batches = usual_batches;
    with_scratch.team_scratch = detail::PairStars::scratch_bytes(rows) + 16;
    for_each_segment(space, mesh_, discrete_gradient_relations, pair, with_scratch);
    Kokkos::deep_copy(words_used_, Kokkos::subview(used_, 0));
    const Offset count = std::min(large_.count(), room.large);
    outgrown_ = {"GALE::outgrown", count};
    if (words_used_ > room.words) return;
    Kokkos::parallel_for(
        "GALE::pair_large_stars", Kokkos::RangePolicy<WorkerSpace, Kokkos::IndexType<Offset>>(space, 0, count),
        detail::PairLargeStars{pair.keys, sink_, words_.data(), pairs_begin_.data(), large_, outgrown_});
    space.fence();
  }

  /// Was there room for all? If not, `room` becomes what there must be.
  bool fitted(Room& room) const {
    const Room had = room;
    const auto raise = [](Offset& to, Offset count) { to = std::max(to, count); };
    raise(room.words, words_used_);
    raise(room.vertices, sink_.critical_vertices.count());
    raise(room.edges, sink_.critical_edges.count());
    raise(room.triangles, sink_.critical_triangles.count());
    raise(room.tetrahedra, sink_.critical_tetrahedra.count());
    raise(room.stars, sink_.stars.count());
    const bool handed = !large_.overflowed(room.large, room.large_words);
    // Segments without room for their rows have found nothing: there may be more of everything.
    if (room.words > had.words) {
      for (Offset* const list : {&room.edges, &room.triangles, &room.tetrahedra}) raise(*list, mesh_.vertices());
    }
    return room.words == had.words && room.vertices == had.vertices && room.edges == had.edges &&
           room.triangles == had.triangles && room.tetrahedra == had.tetrahedra && room.stars == had.stars && handed;
  }

  detail::DeviceGradient found() const {
    detail::DeviceGradient found;
    found.vertex_successor = vertex_successor_;
    found.tetrahedron_successor = tetrahedron_successor_;
    found.pair_words = Kokkos::subview(words_, std::make_pair(Offset(0), words_used_));
    found.pairs_begin = pairs_begin_;
    found.critical.vertices = sink_.critical_vertices.to_host();
    found.critical.edges = sink_.critical_edges.to_host();
    found.critical.triangles = sink_.critical_triangles.to_host();
    found.critical.tetrahedra = sink_.critical_tetrahedra.to_host();
    found.stars = sink_.stars.to_host();
    return found;
  }

  /// Stars that are still unpaired: places among the large ones.
  std::vector<Offset> outgrown() const { return outgrown_.to_host(); }
  const detail::HandedStars& large() const { return large_; }

 private:
  Mesh mesh_;
  Array<Id, Memory> vertex_successor_, tetrahedron_successor_, words_;
  Array<Offset, Memory> pairs_begin_, used_;
  detail::HandedStars large_;
  DeviceList<Offset> outgrown_;
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
