#pragma once

#include <array>
#include <cstdint>

#include <gale/distributed/mesh_part.hpp>
#include <gale/mesh/intervals.hpp>

namespace gale {

/// What one rank hands over of a regular grid, on the host: some of its layers along the slowest axis, which is z, or y
/// of a plane. The layers of ranks follow one another, from the first rank to the last, and are together all of them; a
/// rank may have none. Nothing is written out: each rank's mesh is a grid of these layers and one on either side, whose
/// vertices are its ghosts.
///
/// Ids are those of the whole grid as `Grid` numbers them: those of vertices, and of cells, are counted from the first
/// layer on. The whole may have more of both than 32 bits number.
struct GridLayers {
  std::array<Id, 3> points;  ///< the whole grid's, along x, y and z as Grid has them; the same on all ranks
  Interval layers;           ///< which this rank hands over, and will own

  /// Which points are vertices, in these layers, and in the one before and the one after where there are any: a bit
  /// each, in rows as Grid takes them. Each must be a corner of a cube all of whose corners are vertices. Empty where
  /// all points are.
  Array<std::uint64_t, HostMemory> inside;

  HostPoints positions;  ///< where the vertices of these layers are, which the mesh keeps; on all ranks or on none
};

namespace detail {

/// Shares layers so that ranks own about as many vertices each: the first layer of each rank, then the number of all.
/// vertices_before(layer) vertices lie in lower layers.
template <class VerticesBefore>
std::vector<Id> shared_layers(Id layers, int ranks, const VerticesBefore& vertices_before) {
  std::vector<Id> begin(ranks + 1, layers);
  const Offset all = vertices_before(layers);
  Id layer = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    // The layer whose middle is the first behind the share of those before.
    const auto middle = [&](Id at) { return (Offset(vertices_before(at)) + vertices_before(at + 1)) * ranks; };
    while (layer < layers && middle(layer) < 2 * all * rank) ++layer;
    begin[rank] = layer;
  }
  return begin;
}

}  // namespace detail
}  // namespace gale
