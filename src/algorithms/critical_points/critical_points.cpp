#include <algorithm>
#include <vector>

#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/order/require_mesh.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale {

namespace {

using detail::VertexTypes;
using Memory = detail::MemoryOfSweep<WorkerSpace>;

/// The sweep of consumers on the host.
VertexTypes<HostMemory> classify_vertices(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  detail::require_same_mesh("the vertex order", order.mesh(), structure.mesh());
  const ThreadLimit limit(options.threads);
  const std::uint64_t* const keys = order.keys();
  const VertexTypes<HostMemory> types(structure.mesh());
  std::vector<detail::LargeLink> large(std::max(options.threads, 0));
  structure.for_each_segment(critical_points_relations, options, [&](int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    for (const Id v : rows.interval(Relation::VV)) {
      const Row row = neighbours[v];
      types.set(keys, v, row, detail::topology_of(large[consumer], keys, v, row, links[v]));
    }
  });
  return types;
}

/// A lane a vertex. Links of vertices with up to 32 neighbours, which most have, lie in the team's scratch memory as
/// far as that reaches; others in the lane's own.
struct Classify {
  using Narrow = detail::LinkBits<std::uint32_t>;

  const std::uint64_t* keys;
  VertexTypes<Memory> types;
  detail::HandedStars outgrown;  ///< of too many neighbours for a lane
  int scratch_entries;           ///< of VV that a team has room for

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<Memory>& segment) const {
    const Rows neighbours = segment[Relation::VV];
    const LinkRows links = segment.links();
    auto* const words = reinterpret_cast<std::uint32_t*>(
        team::scratch<0>(team, 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(scratch_entries)));
    team::for_all(team, neighbours.count, [&](int i) {
      const Id v = neighbours.first + i;
      const Row row = neighbours[v];
      const Id before = neighbours.offsets[i] - neighbours.offsets[0];
      if (row.size() <= Narrow::capacity && before + row.size() <= scratch_entries) {
        classify(v, row, Narrow(words + 2 * before, row.size(), links[v]));
      } else if (row.size() <= detail::SmallLink::capacity) {
        classify(v, row, detail::SmallLink(row.size(), links[v]));
      } else {
        outgrown.add({v, row, {}, links[v]});
      }
    });
  }

 private:
  template <class Link>
  KOKKOS_FORCEINLINE_FUNCTION void classify(Id v, const Row& row, const Link& link) const {
    types.set(keys, v, row, link.topology(row.size(), detail::lower_neighbours<typename Link::Word>(keys, v, row)));
  }
};

/// Room in scratch memory for the links of a segment of a regular mesh.
int usual_scratch_entries(const Mesh& mesh) {
  constexpr double neighbours = 17;
  constexpr double most = 2048;  // 16 KiB: hosts have 32
  return static_cast<int>(std::min(neighbours * detail::mean_vertices(mesh), most));
}

/// Has the host classify what lanes handed on.
void add_outgrown(const WorkerSpace& space, const VertexOrder& order, const Classify& sweep) {
  const detail::HandedStars::OnHost stars = sweep.outgrown.to_host();
  const auto found = allocate<Array<detail::LinkTopology, HostMemory>>("GALE::outgrown_types", stars.size());
  std::vector<detail::LargeLink> large(host_threads());
  in_turns(static_cast<int>(large.size()), stars.size(), [&](int thread, std::int64_t i) {
    const VertexStar star = stars[i];
    found(i) = detail::topology_of(large[thread], order.keys(), star.vertex, star.neighbours, star.link);
  });
  const auto there = on_worker(found);
  parallel_for(
      "GALE::add_outgrown", space, there.extent(0), KOKKOS_LAMBDA(Offset i) {
        const VertexStar star = sweep.outgrown[i];
        sweep.types.set(sweep.keys, star.vertex, star.neighbours, there(i));
      });
  space.fence();
}

/// The sweep of consumers where the relations are made, made again where it handed on more than there was room for.
VertexTypes<Memory> classify_vertices(const WorkerSpace& space, const VertexOrder& order,
                                      const DeviceSweepOptions& options) {
  const Mesh& mesh = order.mesh();
  Offset stars = mesh.vertices() / 64 + 256, words = 96 * stars;
  while (true) {
    const Classify sweep{order.keys_in<Memory>().data(), VertexTypes<Memory>(mesh), detail::HandedStars(stars, words),
                         usual_scratch_entries(mesh)};
    DeviceSweepOptions with_scratch = options;
    with_scratch.team_scratch = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(sweep.scratch_entries) + 16;
    for_each_segment(space, mesh, critical_points_relations, sweep, with_scratch);
    if (sweep.outgrown.overflowed(stars, words)) continue;
    if (sweep.outgrown.count() > 0) add_outgrown(space, order, sweep);
    return sweep.types;
  }
}

}  // namespace

CriticalPoints find_critical_points(const VertexOrder& order, const ComputeOptions& options, Computed* computed) {
  return detail::Computing(order.mesh(), options, computed)
      .find(
          critical_points_relations,
          [&](const DeviceSweepOptions& sweep) { return find_critical_points(WorkerSpace(), order, sweep); },
          [&](Structure& structure) { return find_critical_points(structure, order, options); });
}

CriticalPoints find_critical_points(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  VertexTypes<HostMemory> types;
  detail::together(order.mesh().exchange().ranks(), [&] { types = classify_vertices(structure, order, options); });
  const ThreadLimit limit(options.threads);
  return detail::collect(HostExecutionSpace(), order, types);
}

CriticalPoints find_critical_points(const WorkerSpace& space, const VertexOrder& order,
                                    const DeviceSweepOptions& options) {
  VertexTypes<Memory> types;
  detail::together(order.mesh().exchange().ranks(), [&] { types = classify_vertices(space, order, options); });
  return detail::collect(space, order, types);
}

}  // namespace gale
