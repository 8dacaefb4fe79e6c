#include <algorithm>

#include <gale/algorithms/critical_points/classify.hpp>
#include <gale/algorithms/critical_points/collect.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/order/same_mesh.hpp>

namespace gale {

namespace {

using Bytes = Array<std::uint8_t, HostMemory>;

/// The sweep of consumers on the host.
class Classification {
 public:
  Classification(const Mesh& mesh, const VertexOrder& order, int threads)
      : keys_(order.keys()),
        own_(allocate<Bytes>("GALE::vertex_types", mesh.vertices())),
        told_("GALE::surface_neighbours", mesh.vertices()),
        types_(own_.data(), told_.data()),
        large_(std::max(threads, 0)) {}

  void classify(int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    for (const Id v : rows.interval(Relation::VV)) {
      const auto topology = detail::topology_of(large_[consumer], keys_, v, neighbours[v], links[v]);
      types_.set(v, topology);
      if (topology.on_surface) tell(v, neighbours[v]);
    }
  }

  detail::TypeArrays<HostMemory> found() const { return {own_, told_}; }

 private:
  void tell(Id v, const Row& neighbours) {
    for (const Id neighbour : neighbours) types_.tell(neighbour, detail::VertexTypes::seen_from(keys_, neighbour, v));
  }

  const std::uint64_t* keys_;
  Bytes own_, told_;
  detail::VertexTypes types_;
  std::vector<detail::LargeLink> large_;
};

}  // namespace

namespace detail {

TypeArrays<HostMemory> classify_vertices(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  require_same_mesh("the vertex order", order.mesh(), structure.mesh());
  const ThreadLimit limit(options.threads);
  Classification classification(structure.mesh(), order, options.threads);
  structure.for_each_segment(critical_points_relations, options,
                             [&](int consumer, const SegmentRows& rows) { classification.classify(consumer, rows); });
  return classification.found();
}

}  // namespace detail

CriticalPoints find_critical_points(const VertexOrder& order, const ComputeOptions& options, Computed* computed) {
  return detail::Computing(order.mesh(), options, computed)
      .find(
          critical_points_relations,
          [&](const DeviceSweepOptions& sweep) { return find_critical_points(WorkerSpace(), order, sweep); },
          [&](Structure& structure) { return find_critical_points(structure, order, options); });
}

CriticalPoints find_critical_points(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  detail::TypeArrays<HostMemory> found;
  detail::together(order.mesh().exchange().ranks(),
                   [&] { found = detail::classify_vertices(structure, order, options); });
  const ThreadLimit limit(options.threads);
  return detail::collect(HostExecutionSpace(), order, found.types());
}

}  // namespace gale
