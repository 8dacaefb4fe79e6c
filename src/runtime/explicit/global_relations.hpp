#pragma once

#include <array>

#include <gale/mesh/mesh.hpp>
#include <gale/runtime/explicit/global_links.hpp>

namespace gale::detail {

/// Relations of a whole mesh, on the host.
struct GlobalRelations {
  std::array<GlobalRows, relation_count> rows;  ///< of those wanted; of VT at least the offsets where link is
  GlobalLinks links;

  /// By dimension: how many simplices there are, and where those that are internal to each segment begin, and one past
  /// the last. no_id and empty for edges and triangles that nothing wanted.
  std::array<Id, 4> count{no_id, no_id, no_id, no_id};
  std::array<Array<const Id, HostMemory>, 4> segment_begin;
};

/// Computes all rows of the relations wanted, one relation after another, in the workers' space. What only others are
/// computed from goes when the last of them is there. Throws gale::Error if a relation on the way has more entries than
/// an Id counts, before it takes memory for them; and where GALE was built without Kokkos-Kernels.
GlobalRelations global_relations(const Mesh& mesh, RelationSet wanted);

}  // namespace gale::detail
