#pragma once

#include <memory>

#include <gale/relations/structure.hpp>

namespace gale {

/// The global structure: every row of the relations wanted, computed at once with Kokkos-Kernels and kept on the host. Fastest to read where
/// memory allows; and, sharing no code with the segment kernels, what they are tested against.
///
/// Only where GALE was built with Kokkos-Kernels (GALE_ENABLE_KOKKOS_KERNELS); elsewhere the constructor throws gale::Error that says so.
class ExplicitStructure : public Structure {
 public:
  /// `wanted` within star_relations. Memory: 4 bytes an entry and a row; for links 3 an entry of VT, 6 or 12 where a VV row is longer than 256
  /// or 65536. During construction twice what VT and VV take beside them. Throws gale::Error for any other relation; and if one has more than
  /// 2^31 - 1 entries, naming it and their number.
  ExplicitStructure(const Mesh& mesh, RelationSet wanted);
  ~ExplicitStructure() override;

  const Mesh& mesh() const override;
  RelationSet relations() const override;
  void for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) override;
  std::unique_ptr<Consumer> consumer() override;

 private:
  struct Data;
  class ExplicitConsumer;
  std::unique_ptr<const Data> data_;
};

}  // namespace gale
