#pragma once

#include <memory>

#include <gale/runtime/explicit/explicit_relations.hpp>
#include <gale/runtime/structure.hpp>

namespace gale {

/// The global structure: every row of the relations wanted, computed at once and kept on the host. Fastest to read
/// where memory allows; and, sharing no code with the segment kernels nor with the enumeration of `Mesh`, what they are
/// tested against.
///
/// Computed in the workers' space: edges and triangles are numbered by sorting those of all tetrahedra; coboundary
/// relations are transposed graphs and adjacency relations products of graphs, by Kokkos-Kernels. Only where GALE was
/// built with that (GALE_ENABLE_KOKKOS_KERNELS); elsewhere the constructor throws gale::Error that says so.
///
/// Memory: 4 bytes an entry and a row of each relation, but none for TV's entries without a device: those are the
/// mesh's own. Links take 3 bytes an entry of VT, 6 or 12 where a VV row is longer than 256 or 65536, and VT's offsets.
/// All sixteen and the links take 560 bytes a tetrahedron of a grid.
class ExplicitStructure : public Structure {
 public:
  /// Computes the relations one after another and, before each, those that it is computed from: a coboundary relation
  /// XY from YX; an adjacency relation XX from XY and YX, where Y is what two X share (in VV a tetrahedron); EV from
  /// TE, FV and FE from TF, TF from TE. The mesh isn't made to number its simplices.
  ///
  /// Relations that aren't wanted go when they have served. Beside what is kept, in the workers' memory, numbering the
  /// edges takes 144 bytes a tetrahedron, then the triangles 120, and an adjacency relation what it is computed from, 4
  /// bytes an entry and 16 a row.
  ///
  /// Throws gale::Error if one of those relations has more than 2^31 - 1 entries, naming it and their number, before it
  /// takes memory for them.
  ExplicitStructure(const Mesh& mesh, RelationSet wanted);

  bool keeps_all_rows() const override { return true; }
  std::unique_ptr<Consumer> consumer() override;

  /// How many simplices of a dimension 0 to 3 there are; no_id for edges and triangles that no relation wanted is
  /// computed from.
  Id count(int dimension) const override;

 protected:
  std::unique_ptr<Sweep> begin_sweep(RelationSet wanted, int consumers, const SegmentBody& body) override;

 private:
  class ExplicitConsumer;
  const detail::ExplicitRelations all_;
};

}  // namespace gale
