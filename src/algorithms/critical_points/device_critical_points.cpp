#include <algorithm>
#include <memory>
#include <vector>

#include <gale/algorithms/critical_points/classify.hpp>
#include <gale/algorithms/critical_points/collect.hpp>
#include <gale/algorithms/links/large_link.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale {

namespace {

using Memory = detail::MemoryOfSweep<WorkerSpace>;
using DeviceBytes = Array<std::uint8_t, Memory>;

/// A lane a vertex. Links of vertices with up to 32 neighbours, which most have, lie in the team's scratch memory as
/// far as that reaches; others in the lane's own.
struct Classify {
  using Narrow = detail::LinkBits<std::uint32_t>;

  const std::uint64_t* keys;
  detail::VertexTypes types;
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
struct HostClassification {
  detail::LargeLink link;
  FoundOnHost found;

  void classify(const std::uint64_t* keys, const VertexStar& star) {
    const auto topology = detail::topology_of(link, keys, star.vertex, star.neighbours, star.link);
    found.own.push_back({star.vertex, topology});
    if (!topology.on_surface) return;
    for (const Id neighbour : star.neighbours)
      found.told.push_back({neighbour, detail::VertexTypes::seen_from(keys, neighbour, star.vertex)});
  }
};

FoundOnHost classify_on_host(const VertexOrder& order, const detail::HandedStars::OnHost& stars) {
  const std::uint64_t* const keys = order.keys();
  std::vector<HostClassification> threads(host_threads());
  in_turns(static_cast<int>(threads.size()), stars.size(),
           [&](int thread, std::int64_t i) { threads[thread].classify(keys, stars[i]); });
  FoundOnHost all;
  for (const auto& [link, found] : threads) {
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
  constexpr double most = 2048;  // 16 KiB: hosts have 32
  const double vertices = static_cast<double>(mesh.vertices()) / std::max(mesh.segments(), Id(1));
  return static_cast<int>(std::min(neighbours * vertices, most));
}

/// What a sweep leaves: types, and the stars that it handed on.
struct Classified {
  DeviceBytes own, told;
  detail::HandedStars outgrown;
};

Classified classify_all(const WorkerSpace& space, const VertexOrder& order, const DeviceSweepOptions& options,
                        Offset stars, Offset words) {
  const Mesh& mesh = order.mesh();
  // Neighbours are told in words of four bytes on a device.
  const Classified found{allocate<DeviceBytes>("GALE::vertex_types", mesh.vertices()),
                         allocate<DeviceBytes>("GALE::surface_neighbours", (mesh.vertices() + 3) / 4 * 4),
                         detail::HandedStars(stars, words)};
  Kokkos::deep_copy(space, found.told, std::uint8_t(0));
  const Classify classify{order.keys_in<Memory>().data(),
                          {found.own.data(), found.told.data()},
                          found.outgrown,
                          usual_scratch_entries(mesh)};
  DeviceSweepOptions with_scratch = options;
  with_scratch.team_scratch = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(classify.scratch_entries) + 16;
  for_each_segment(space, mesh, critical_points_relations, classify, with_scratch);
  return found;
}

}  // namespace

namespace detail {

TypeArrays<Memory> classify_vertices(const WorkerSpace& space, const VertexOrder& order,
                                     const DeviceSweepOptions& options) {
  Offset stars = order.mesh().vertices() / 64 + 256, words = 96 * stars;
  auto classified = std::make_unique<Classified>(classify_all(space, order, options, stars, words));
  while (classified->outgrown.overflowed(stars, words)) {
    classified.reset();
    classified = std::make_unique<Classified>(classify_all(space, order, options, stars, words));
  }
  const TypeArrays<Memory> found{classified->own, classified->told};
  if (classified->outgrown.count() > 0)
    add(space, classify_on_host(order, classified->outgrown.to_host()), found.types());
  return found;
}

}  // namespace detail

CriticalPoints find_critical_points(const WorkerSpace& space, const VertexOrder& order,
                                    const DeviceSweepOptions& options) {
  detail::TypeArrays<Memory> found;
  detail::together(order.mesh().exchange().ranks(), [&] { found = detail::classify_vertices(space, order, options); });
  return detail::collect(space, order, found.types());
}

}  // namespace gale
