#pragma once

#include <gale/algorithms/gradient/grid_pairs.hpp>
#include <gale/algorithms/gradient/lane_sink.hpp>
#include <gale/algorithms/gradient/pair_fan.hpp>
#include <gale/mesh/intervals.hpp>

// Gradients of grids by kernels. Where each row of edges begins is known before, so that a lane needs no others.

namespace gale::detail {

/// Pairs the lower stars of a grid of tetrahedra, a lane a vertex: those of vertices that have all their cubes.
struct PairGridStars {
  GridView grid;
  const StarKind* kinds;
  const WholeStar* whole;
  const std::uint64_t* keys;
  Interval owned;
  LaneSink sink;
  Id* words;
  const Offset* pairs_begin;
  DeviceList<Id> left;  ///< the other vertices

  KOKKOS_FUNCTION void operator()(Offset i) const {
    GridCursor at(grid);
    const Id vertex = owned.first + static_cast<Id>(i);
    at.go_to(vertex);
    const LaneSink::Lane lane{{sink.vertex_successor, sink.cell_successor, &sink.found}, words + pairs_begin[vertex]};
    if (at.kind() != grid_kinds - 1 || !pair_on_grid<have_device>(lane, *whole, keys, at)) left.add(vertex);
  }

  /// What the row of a vertex takes.
  KOKKOS_FUNCTION Offset words_for(Offset vertex) const {
    if (!owned.has(static_cast<Id>(vertex))) return 0;
    GridCursor at(grid);
    at.go_to(static_cast<Id>(vertex));
    const StarKind& kind = kinds[at.kind()];
    Id lower = 0;
    for (int k = 0; k < kind.neighbours; ++k) lower += keys[at.neighbour(kind.direction[k])] < keys[vertex];
    return EdgePairRow::words_for(lower);
  }
};

/// Counts what the rows take that PairGridStars fills.
struct CountGridWords {
  PairGridStars pair;
  Offset* words;  ///< by vertex

  KOKKOS_FUNCTION void operator()(Offset vertex) const { words[vertex] = pair.words_for(vertex); }
};

/// Pairs the stars that PairGridStars has left.
struct PairOtherGridStars {
  PairGridStars all;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    GridCursor at(all.grid);
    GridStarRows rows;
    at.go_to(all.left[i]);
    const VertexStar star = rows.at(at, all.kinds[at.kind()], 3);
    Id* const row = all.words + all.pairs_begin[star.vertex];
    if (!all.sink.pair<1>(all.keys, star, row)) all.sink.pair<2>(all.keys, star, row);
  }
};

/// Pairs the lower stars of a grid of triangles, a lane a vertex.
struct PairGridFans {
  GridView grid;
  const StarKind* kinds;
  const std::uint64_t* keys;
  Interval owned;
  LaneSink sink;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    GridCursor at(grid);
    GridStarRows rows;
    at.go_to(owned.first + static_cast<Id>(i));
    pair_small_fan<8>(StarSink<LaneFound>{sink.vertex_successor, sink.cell_successor, &sink.found}, keys,
                      rows.at(at, kinds[at.kind()], 2));
  }
};

}  // namespace gale::detail
