#include <algorithm>
#include <memory>
#include <vector>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/critical_points/collect.hpp>
#include <gale/algorithms/critical_points/vertex_types.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/host_worker.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale {

namespace {

using Memory = detail::MemoryOfSweep<WorkerSpace>;
using DeviceBytes = Array<std::uint8_t, Memory>;

/// Vertices of too many neighbours for a lane.
struct Outgrown {
  Array<Id, Memory> vertices;
  Array<Id, Memory> count;

  KOKKOS_FUNCTION void add(Id v) const { vertices(atomic_add(count.data(), Id(1))) = v; }
};

/// A lane a vertex. Links of vertices with up to 32 neighbours, which most have, lie in the team's scratch memory as
/// far as that reaches; others in the lane's own.
struct Classify {
  using Narrow = detail::LinkBits<std::uint32_t>;

  const std::uint64_t* keys;
  detail::VertexTypes types;
  Outgrown outgrown;
  int scratch_entries;  ///< of VV that a team has room for

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
        outgrown.add(v);
      }
    });
  }

 private:
  template <class Link>
  KOKKOS_FORCEINLINE_FUNCTION void classify(Id v, const Row& row, const Link& link) const {
    const auto lower = detail::lower_neighbours<typename Link::Word>(keys, v, row);
    const auto topology = link.topology(row.size(), lower);
    types.set(v, topology);
    if (!topology.on_surface) return;
    for (const Id neighbour : row) types.tell(neighbour, detail::VertexTypes::seen_from(keys, neighbour, v));
  }
};

/// What the host finds of vertices that outgrew a lane.
struct FoundOnHost {
  struct Own {
    Id vertex;
    detail::LinkTopology topology;
  };
  struct Told {
    Id neighbour;
    std::uint8_t what;
  };
  std::vector<Own> own;
  std::vector<Told> told;
};

/// One thread's part in that.
class HostClassification {
 public:
  explicit HostClassification(const VertexOrder& order)
      : keys_(order.keys()), rows_(order.mesh(), critical_points_relations) {}

  /// Some vertices of a segment.
  void classify(Id segment, const Id* begin, const Id* end) {
    const SegmentRows rows = rows_.compute(segment);
    for (const Id* v = begin; v != end; ++v) {
      const Row neighbours = rows[Relation::VV][*v];
      const auto topology = detail::topology_of(link_, keys_, *v, neighbours, rows.links()[*v]);
      found_.own.push_back({*v, topology});
      if (!topology.on_surface) continue;
      for (const Id neighbour : neighbours)
        found_.told.push_back({neighbour, detail::VertexTypes::seen_from(keys_, neighbour, *v)});
    }
  }

  const FoundOnHost& found() const { return found_; }

 private:
  const std::uint64_t* keys_;
  HostWorker rows_;
  detail::LargeLink link_;
  FoundOnHost found_;
};

FoundOnHost classify_on_host(const VertexOrder& order, std::vector<Id> vertices) {
  const Mesh& mesh = order.mesh();
  std::sort(vertices.begin(), vertices.end());
  std::vector<std::unique_ptr<HostClassification>> threads(host_threads());
  in_turns(static_cast<int>(threads.size()), mesh.segments(), [&](int thread, std::int64_t segment) {
    const Id* const all = vertices.data();
    const Id* const begin = std::lower_bound(all, all + vertices.size(), mesh.vertex_begin()(segment));
    const Id* const end = std::lower_bound(begin, all + vertices.size(), mesh.vertex_begin()(segment + 1));
    if (begin == end) return;
    if (!threads[thread]) threads[thread] = std::make_unique<HostClassification>(order);
    threads[thread]->classify(static_cast<Id>(segment), begin, end);
  });
  FoundOnHost all;
  for (const auto& thread : threads) {
    if (!thread) continue;
    const FoundOnHost& found = thread->found();
    all.own.insert(all.own.end(), found.own.begin(), found.own.end());
    all.told.insert(all.told.end(), found.told.begin(), found.told.end());
  }
  return all;
}

template <class T>
auto on_worker(const std::vector<T>& values) {
  return gale::on_worker(Kokkos::View<const T*, HostMemory, Kokkos::MemoryUnmanaged>(values.data(), values.size()));
}

void add(const WorkerSpace& space, const FoundOnHost& found, const detail::VertexTypes& types) {
  const auto own = on_worker(found.own);
  const auto told = on_worker(found.told);
  parallel_for(
      "GALE::own_types", space, own.extent(0), KOKKOS_LAMBDA(Offset i) { types.set(own(i).vertex, own(i).topology); });
  parallel_for(
      "GALE::told_types", space, told.extent(0),
      KOKKOS_LAMBDA(Offset i) { types.tell(told(i).neighbour, told(i).what); });
  space.fence();
}

/// Room in scratch memory for the links of a segment of a regular mesh.
int usual_scratch_entries(const Mesh& mesh) {
  constexpr double neighbours = 17;
  constexpr int most = 4096;
  const double vertices = static_cast<double>(mesh.vertices()) / mesh.segments();
  return std::min(static_cast<int>(neighbours * vertices), most);
}

}  // namespace

CriticalPoints find_critical_points(const WorkerSpace& space, const VertexOrder& order,
                                    const DeviceSweepOptions& options) {
  const Mesh& mesh = order.mesh();
  const auto own = allocate<DeviceBytes>("GALE::vertex_types", mesh.vertices());
  const DeviceBytes told("GALE::surface_neighbours", mesh.vertices());
  const Outgrown outgrown{allocate<Array<Id, Memory>>("GALE::outgrown", mesh.vertices()),
                          Array<Id, Memory>("GALE::outgrown_count", 1)};
  Classify classify{order.keys_in<Memory>().data(), {own.data(), told.data()}, outgrown, usual_scratch_entries(mesh)};
  DeviceSweepOptions with_scratch = options;
  with_scratch.team_scratch = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(classify.scratch_entries) + 16;
  for_each_segment(space, mesh, critical_points_relations, classify, with_scratch);
  Id count = 0;
  Kokkos::deep_copy(count, Kokkos::subview(outgrown.count, 0));
  if (count > 0) {
    const auto list = on_host(Kokkos::subview(outgrown.vertices, std::make_pair(Id(0), count)));
    add(space, classify_on_host(order, {list.data(), list.data() + count}), classify.types);
  }
  return detail::collect(space, mesh, classify.types);
}

}  // namespace gale
