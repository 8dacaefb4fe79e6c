#pragma once

#include <gale/algorithms/gradient/lane_sink.hpp>
#include <gale/algorithms/gradient/pair_fan.hpp>
#include <gale/base/team.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale::detail {

/// Pairs the lower stars of the vertices of a triangle mesh's segment, a lane a vertex.
struct PairFans {
  const std::uint64_t* keys;
  LaneSink sink;
  HandedStars large;  ///< what lanes can't hold

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<MemoryOfSweep<WorkerSpace>>& segment) const {
    const Rows neighbours = segment[Relation::VV], triangles = segment[Relation::VF];
    const LinkRows links = segment.links();
    team::for_all(team, neighbours.count, [&](int i) {
      const Id v = neighbours.first + i;
      const VertexStar star{v, neighbours[v], triangles[v], links[v]};
      const StarSink<LaneFound> lane{sink.vertex_successor, sink.cell_successor, &sink.found};
      if (!pair_small_fan(lane, keys, star)) large.add(star);
    });
  }
};

}  // namespace gale::detail
