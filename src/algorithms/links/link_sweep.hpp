#pragma once

#include <algorithm>

#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/team.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale::detail {

/// Has kernels call visit(v, neighbours, link) for each vertex, a lane a vertex. Links of vertices with up to 32
/// neighbours, which most have, lie in the team's scratch memory as far as that reaches; others in the lane's own.
template <class Visit>
struct LinkSweep {
  using Narrow = LinkBits<std::uint32_t>;

  Visit visit;
  HandedStars outgrown;  ///< of too many neighbours for a lane
  int scratch_entries;   ///< of VV that a team has room for

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<MemoryOfSweep<WorkerSpace>>& segment) const {
    const Rows neighbours = segment[Relation::VV];
    const LinkRows links = segment.links();
    auto* const words = reinterpret_cast<std::uint32_t*>(
        team::scratch<0>(team, 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(scratch_entries)));
    team::for_all(team, neighbours.count, [&](int i) {
      const Id v = neighbours.first + i;
      const Row row = neighbours[v];
      const Id before = neighbours.offsets[i] - neighbours.offsets[0];
      if (row.size() <= Narrow::capacity && before + row.size() <= scratch_entries) {
        visit(v, row, Narrow(words + 2 * before, row.size(), links[v]));
      } else if (row.size() <= SmallLink::capacity) {
        visit(v, row, SmallLink(row.size(), links[v]));
      } else {
        outgrown.add({v, row, {}, links[v]});
      }
    });
  }
};

/// Makes such a sweep with the visit that make() gives; again with a new one, if more was handed on than there was room
/// for. Returns it when it is done.
template <class Make>
auto sweep_links(const WorkerSpace& space, const Mesh& mesh, const DeviceSweepOptions& options, const Make& make) {
  constexpr double neighbours = 17;  // on a regular mesh
  constexpr double most = 2048;      // 16 KiB: hosts have 32
  const auto scratch_entries = static_cast<int>(std::min(neighbours * mean_vertices(mesh), most));
  DeviceSweepOptions with_scratch = options;
  with_scratch.team_scratch = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(scratch_entries) + 16;
  Offset stars = mesh.vertices() / 64 + 256, words = 96 * stars;
  while (true) {
    const LinkSweep<decltype(make())> sweep{make(), HandedStars(stars, words), scratch_entries};
    for_each_segment(space, mesh, Relation::VV | link_form, sweep, with_scratch);
    if (!sweep.outgrown.overflowed(stars, words)) return sweep;
  }
}

}  // namespace gale::detail
