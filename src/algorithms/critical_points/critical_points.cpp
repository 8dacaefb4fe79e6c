#include <algorithm>
#include <vector>

#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/link_sweep.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

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

/// What a lane does with a vertex.
struct Classify {
  const std::uint64_t* keys;
  VertexTypes<Memory> types;

  template <class Link>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(Id v, const Row& row, const Link& link) const {
    types.set(keys, v, row, link.topology(row.size(), detail::lower_neighbours<typename Link::Word>(keys, v, row)));
  }
};

/// Has the host classify what lanes handed on.
void add_outgrown(const WorkerSpace& space, const VertexOrder& order, const detail::LinkSweep<Classify>& sweep) {
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
        sweep.visit.types.set(sweep.visit.keys, star.vertex, star.neighbours, there(i));
      });
  space.fence();
}

/// The sweep of consumers where the relations are made.
VertexTypes<Memory> classify_vertices(const WorkerSpace& space, const VertexOrder& order,
                                      const DeviceSweepOptions& options) {
  const auto sweep = detail::sweep_links(space, order.mesh(), options, [&] {
    return Classify{order.keys_in<Memory>().data(), VertexTypes<Memory>(order.mesh())};
  });
  if (sweep.outgrown.count() > 0) add_outgrown(space, order, sweep);
  return sweep.visit.types;
}

}  // namespace

CriticalPoints find_critical_points(const VertexOrder& order, const ComputeOptions& options, Computed* computed) {
  detail::Computing computing(order.mesh(), options, computed);
  if (computing.is_of_grid()) {
    return computing.find_alone(
        [&](const DeviceSweepOptions&) { return detail::critical_points_of_grid(WorkerSpace(), order, options); },
        [&] { return detail::critical_points_of_grid(HostExecutionSpace(), order, options); });
  }
  return computing.find(
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
