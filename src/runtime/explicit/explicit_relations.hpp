#pragma once

#include <array>
#include <string>

#include <gale/base/csr.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

/// Relations of a whole mesh, on the host, as the explicit structure keeps them.
struct ExplicitRelations {
  std::array<Csr<const Id, HostMemory, Id>, relation_count>
      kept;  ///< what is wanted; of VT or VF at least the offsets for links

  int dimension = 3;  ///< of the mesh
  Array<std::uint8_t, HostMemory> link_places;
  int link_width = 1;  ///< bytes of a place

  /// By dimension: how many simplices there are, and where those that are internal to each segment begin, and one past
  /// the last. no_id and empty for edges and triangles that nothing wanted needs.
  std::array<Id, 4> count{no_id, no_id, no_id, no_id};
  std::array<Array<const Id, HostMemory>, 4> segment_begin;

  /// All rows of a relation.
  Rows rows(Relation relation) const {
    const auto& all = kept[static_cast<int>(relation)];
    return {0, static_cast<Id>(all.rows()), all.offsets.data(), all.entries.data()};
  }

  /// The links of all vertices.
  LinkRows links() const {
    const Rows stars = rows(vertex_cells(dimension));
    return {0, stars.count, stars.offsets, link_places.data(), link_width, dimension};
  }
};

/// Computes all rows of the relations wanted in the workers' space: one relation to faces after another, each with what
/// is computed from it. What isn't wanted goes when that is there. Throws gale::Error if a relation on the way has more
/// entries than an Id counts, before it takes memory for them; and where GALE was built without Kokkos-Kernels.
ExplicitRelations explicit_relations(const Mesh& mesh, RelationSet wanted);

// What Kokkos-Kernels computes, in the workers' space.

/// Throws gale::Error where GALE was built without Kokkos-Kernels. So do the two that follow.
void require_kokkos_kernels();

/// The coboundary XY from its faces YX: its transpose. Rows ascend. `rows`: how many X there are.
Csr<const Id, WorkerMemory> transpose(Relation relation, const Csr<const Id, WorkerMemory>& faces, Id rows);

/// The adjacency XX from XY and YX: which X share a Y, none of them with itself. Rows ascend. While it works it takes 4
/// bytes an entry, 16 a row and what Kokkos-Kernels hashes with beside the result. Throws gale::Error if it has more
/// entries than an Id counts, before it takes memory for them.
Csr<const Id, WorkerMemory> neighbours(Relation relation, const Csr<const Id, WorkerMemory>& xy,
                                       const Csr<const Id, WorkerMemory>& yx);

/// "GALE::VV": what kernels and arrays of a relation are called.
std::string label_of(Relation relation);

/// Throws gale::Error, naming both, if a relation's entries are more than an Id counts.
void require_countable(Relation relation, Offset entries);

}  // namespace gale::detail
