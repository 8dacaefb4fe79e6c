#pragma once

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/excerpt/wider_keys.hpp>
#include <gale/algorithms/gradient/edges_in_kernels.hpp>
#include <gale/base/key_table.hpp>

namespace gale::detail {

/// Edges that other ranks have told of, for kernels: those that are critical or paired with triangles. Copies share
/// them.
struct ToldEdges {
  IdTable thirds;           ///< by their ends, the higher one first
  Offset first_number = 0;  ///< behind those of own edges

  KOKKOS_FUNCTION PairedEdge operator()(Id high, Id low) const {
    const std::uint64_t place = thirds.find(pair_key(high, low));
    if (place == KeyTable::none) return {0, edge_has_vertex};
    return {first_number + static_cast<Offset>(place), thirds.at(place)};
  }
};

/// What kernels read of a gradient that kernels found, to follow walls through it. Owns nothing but what was told.
struct WallRows {
  EdgesInKernels own;
  ToldEdges told;
  NamedKeys keys;
  VertexNames names;  ///< compare as input ids do

  KOKKOS_FUNCTION PairedEdge edge(Id high, Id low) const {
    return own.owned.has(high) ? own(high, low) : told(high, low);
  }

  /// Numbers of edges are below.
  Offset edges() const { return own.count + told.thirds.places(); }
};

/// What kernels read of a gradient by itself.
WallRows wall_rows(const DiscreteGradient& gradient);

/// A wider gradient as kernels read it. Takes 24 to 48 bytes for each edge that was told in the workers' memory.
class WiderRows {
 public:
  /// Copies it there. Throws OutOfMemory. Refers to the gradient.
  explicit WiderRows(const WiderGradient& wider);

  const WallRows& rows() const { return rows_; }

 private:
  const WiderKeys keys_;
  const WiderKeysIn<WorkerMemory> keys_there_;
  WallRows rows_;
};

}  // namespace gale::detail
