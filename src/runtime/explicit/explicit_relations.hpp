#pragma once

#include <array>

#include <gale/base/csr.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// Relations of a whole mesh, on the host, as the explicit structure keeps them.
struct ExplicitRelations {
  std::array<Csr<const Id, HostMemory, Id>, relation_count>
      kept;  ///< those wanted; of VT at least the offsets for links

  Array<std::uint8_t, HostMemory> link_places;
  int link_width = 1;  ///< bytes of a place

  /// By dimension: how many simplices there are, and where those that are internal to each segment begin, and one past
  /// the last. no_id and empty for edges and triangles that nothing wanted.
  std::array<Id, 4> count{no_id, no_id, no_id, no_id};
  std::array<Array<const Id, HostMemory>, 4> segment_begin;

  /// All rows of a relation.
  Rows rows(Relation relation) const {
    const auto& all = kept[static_cast<int>(relation)];
    return {0, static_cast<Id>(all.rows()), all.offsets.data(), all.entries.data()};
  }

  /// The links of all vertices.
  LinkRows links() const {
    const Rows vt = rows(Relation::VT);
    return {0, vt.count, vt.offsets, link_places.data(), link_width};
  }
};

/// Computes all rows of the relations wanted, one relation after another, in the workers' space. What only others are
/// computed from goes when the last of them is there. Throws gale::Error if a relation on the way has more entries than
/// an Id counts, before it takes memory for them; and where GALE was built without Kokkos-Kernels.
ExplicitRelations explicit_relations(const Mesh& mesh, RelationSet wanted);

}  // namespace gale::detail
