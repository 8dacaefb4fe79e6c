#include <algorithm>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/algorithms/order/same_mesh.hpp>
#include <gale/base/parallel.hpp>

namespace gale {

namespace {

using HostSpace = Kokkos::DefaultHostExecutionSpace;
using Bytes = Array<std::uint8_t, HostMemory>;

CriticalType type_of(const detail::LinkTopology& topology) {
  const auto is = [&](int lower, int upper) { return topology.lower == lower && topology.upper == upper; };
  if (is(0, 1)) return CriticalType::minimum;
  if (is(2, 1)) return CriticalType::saddle1;
  if (is(1, 2)) return CriticalType::saddle2;
  if (is(1, 0)) return CriticalType::maximum;
  if (is(1, 1)) return CriticalType::regular;
  return CriticalType::degenerate;
}

/// The sweep. It finds the type of each vertex by the vertex's own link. Vertices on the surface tell their neighbours
/// that they are, as the type of a neighbour on the surface depends on that.
class Classification {
 public:
  Classification(const Mesh& mesh, const VertexOrder& order, int threads)
      : keys_(order.keys()),
        own_(allocate<Bytes>("GALE::vertex_types", mesh.vertices())),
        told_("GALE::surface_neighbours", mesh.vertices()),
        large_(std::max(threads, 0)) {}

  void classify(int consumer, const SegmentRows& rows) {
    const Rows neighbours = rows[Relation::VV];
    const LinkRows links = rows.links();
    for (const Id v : rows.interval(Relation::VV)) classify(large_[consumer], v, neighbours[v], links[v]);
  }

  CriticalType type(Id v) const {
    const auto type = static_cast<CriticalType>(own_(v) & type_mask);
    if (type != CriticalType::regular || !on_surface(v)) return type;
    if (told_(v) == upper_on_surface) return CriticalType::saddle1;
    if (told_(v) == lower_on_surface) return CriticalType::saddle2;
    return CriticalType::regular;
  }

  bool on_surface(Id v) const { return own_(v) & surface_bit; }

 private:
  static constexpr std::uint8_t type_mask = 7, surface_bit = 8;
  static constexpr std::uint8_t upper_on_surface = 1, lower_on_surface = 2;

  void classify(detail::LargeLink& large, Id v, const Row& neighbours, const LinkRow& link) {
    const auto topology = topology_of(large, v, neighbours, link);
    own_(v) = static_cast<std::uint8_t>(type_of(topology)) | (topology.on_surface ? surface_bit : 0);
    if (topology.on_surface) tell(v, neighbours);
  }

  detail::LinkTopology topology_of(detail::LargeLink& large, Id v, const Row& neighbours, const LinkRow& link) const {
    const std::uint64_t key = keys_[v];
    if (neighbours.size() > detail::SmallLink::capacity) {
      large.build(link);
      return large.topology(neighbours.size(), [&](Id i) { return keys_[neighbours[i]] < key; });
    }
    std::uint64_t lower = 0;
    for (Id i = 0; i < neighbours.size(); ++i) lower |= std::uint64_t(keys_[neighbours[i]] < key) << i;
    return detail::small_topology(neighbours.size(), link, lower);
  }

  void tell(Id v, const Row& neighbours) {
    for (const Id neighbour : neighbours) {
      const auto what = keys_[v] > keys_[neighbour] ? upper_on_surface : lower_on_surface;
      __atomic_fetch_or(&told_(neighbour), what, __ATOMIC_RELAXED);
    }
  }

  const std::uint64_t* keys_;
  Bytes own_;
  Bytes told_;
  std::vector<detail::LargeLink> large_;
};

CriticalPoints collect(const Mesh& mesh, const Classification& classification) {
  const Offset count = mesh.vertices();
  const Id* const internal = mesh.vertex_internal().data();
  const auto place = allocate<Array<Id, HostMemory>>("GALE::critical_place", count + 1);
  const auto is_critical = [&](Offset i) { return classification.type(internal[i]) != CriticalType::regular; };
  const Id total = exclusive_scan("GALE::count_critical", HostSpace(), count, place, is_critical);
  CriticalPoints points;
  points.vertices.resize(total);
  points.types.resize(total);
  points.on_surface.resize(total);
  parallel_for("GALE::collect_critical", HostSpace(), count, [&](Offset i) {
    if (place(i + 1) == place(i)) return;
    const Id at = place(i);
    points.vertices[at] = static_cast<Id>(i);
    points.types[at] = classification.type(internal[i]);
    points.on_surface[at] = classification.on_surface(internal[i]);
  });
  for (const CriticalType type : points.types) ++points.counts[static_cast<int>(type)];
  return points;
}

}  // namespace

CriticalPoints find_critical_points(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  detail::require_same_mesh("the vertex order", order.mesh(), structure.mesh());
  const ThreadLimit limit(options.threads);
  Classification classification(structure.mesh(), order, options.threads);
  structure.for_each_segment(critical_points_relations, options,
                             [&](int consumer, const SegmentRows& rows) { classification.classify(consumer, rows); });
  return collect(structure.mesh(), classification);
}

}  // namespace gale
