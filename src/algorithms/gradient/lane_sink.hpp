#pragma once

#include <gale/algorithms/gradient/lane_found.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>

namespace gale::detail {

/// Where lanes put what they find. Each has a row of edges in a place of its own.
struct LaneSink {
  Id *vertex_successor, *cell_successor;
  FoundSimplices<DeviceList> found;

  struct Lane : StarSink<LaneFound> {
    Id* row;

    KOKKOS_FORCEINLINE_FUNCTION EdgePairRow begin_edges(Id, Id count) const {
      EdgePairRow edges(row);
      edges.begin(count);
      return edges;
    }
  };

  /// Pairs a star of so many words of cells; false if it has more.
  template <int Words>
  KOKKOS_FUNCTION bool pair(const std::uint64_t* keys, const VertexStar& star, Id* row) const {
    LowerNeighbours lower;
    return lower.find(keys, star.vertex, star.neighbours) &&
           pair_star_of_words<Words, have_device>(Lane{{vertex_successor, cell_successor, &found}, row}, star, lower);
  }
};

}  // namespace gale::detail
