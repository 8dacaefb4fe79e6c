#include <algorithm>
#include <array>
#include <vector>

#include <gale/algorithms/surface_vertices.hpp>
#include <gale/relations/host_worker.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale {

namespace {

// A triangle at v is an edge of the link of v, and the tetrahedra that it has are the link's triangles at that edge.

/// Calls visit(low, high) with the three edges of each triangle of the link.
template <class Visit>
void for_each_edge(const LinkRow& link, const Visit& visit) {
  for (Id i = 0; i < link.size(); ++i) {
    visit(link(i, 0), link(i, 1));
    visit(link(i, 0), link(i, 2));
    visit(link(i, 1), link(i, 2));
  }
}

/// For vertices of at most 64 neighbours: a word of bits for each, which edges to higher ones were seen, and which
/// again.
class SmallLinkEdges {
 public:
  static constexpr Id capacity = 64;

  bool any_single(Id degree, const LinkRow& link) {
    std::fill_n(seen_.begin(), degree, 0);
    std::fill_n(seen_again_.begin(), degree, 0);
    for_each_edge(link, [this](Id low, Id high) {
      const std::uint64_t bit = std::uint64_t(1) << high;
      seen_again_[low] |= seen_[low] & bit;
      seen_[low] |= bit;
    });
    std::uint64_t single = 0;
    for (Id i = 0; i < degree; ++i) single |= seen_[i] & ~seen_again_[i];
    return single != 0;
  }

 private:
  std::array<std::uint64_t, capacity> seen_{}, seen_again_{};
};

/// For any number of neighbours: the edges, sorted.
class LargeLinkEdges {
 public:
  bool any_single(const LinkRow& link) {
    edges_.clear();
    for_each_edge(link, [this](Id low, Id high) { edges_.push_back(std::uint64_t(low) << 32 | std::uint64_t(high)); });
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t i = 0, next = 0; i < edges_.size(); i = next) {
      for (next = i + 1; next < edges_.size() && edges_[next] == edges_[i];) ++next;
      if (next == i + 1) return true;
    }
    return false;
  }

 private:
  std::vector<std::uint64_t> edges_;
};

/// What one thread works with.
struct Worker {
  HostWorker worker;
  SmallLinkEdges small;
  LargeLinkEdges large;

  explicit Worker(const Mesh& mesh) : worker(mesh, Relation::VV | link_form) {}

  bool is_on_surface(Id degree, const LinkRow& link) {
    return degree <= SmallLinkEdges::capacity ? small.any_single(degree, link) : large.any_single(link);
  }
};

}  // namespace

Array<std::uint8_t, HostMemory> surface_vertices(const Mesh& mesh) {
  const auto on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", mesh.vertices());
  const SweepOptions options;
  std::vector<std::unique_ptr<Worker>> workers(options.threads);
  detail::sweep(mesh.segments(), options, [&](int consumer, Id segment) {
    auto& worker = workers[consumer];
    if (!worker) worker = std::make_unique<Worker>(mesh);
    const SegmentRows rows = worker->worker.compute(segment);
    for (const Id v : rows.interval(Relation::VV)) {
      on_surface(v) = worker->is_on_surface(rows[Relation::VV][v].size(), rows.links()[v]);
    }
  });
  return on_surface;
}

}  // namespace gale
