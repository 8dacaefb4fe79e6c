#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/runtime/device/handed_stars.hpp>

namespace gale::detail {

template <class T>
KOKKOS_FORCEINLINE_FUNCTION void append(const DeviceList<T>& list, const T& item) {
  list.add(item);
}

/// Critical simplices as the lanes of kernels find them.
using LaneFound = const FoundSimplices<DeviceList>;

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
