#pragma once

#include <array>
#include <vector>

#include <gale/export.hpp>
#include <gale/relations/relation.hpp>

namespace gale::baselines {

/// What touches what among some tetrahedra: it lists all simplices and searches the lists, slow and simple, without any
/// code of the kernels. Edges and triangles are numbered as their vertices, which ascend, compare.
class GALE_EXPORT BruteForce {
 public:
  using Table = std::vector<std::vector<Id>>;  ///< ascending ids, by simplex

  /// Vertices 0 to `vertices` - 1, and tetrahedra whose corners come in any order. Both keep their numbers.
  BruteForce(Id vertices, std::vector<std::array<Id, 4>> tetrahedra);

  /// The vertices of all simplices of a dimension. Found at the first call; this and `rows` by one thread at a time.
  const Table& simplices(int dimension) const;

  /// The rows of a relation. Found at the first call.
  const Table& rows(Relation relation) const;

 private:
  Table find_simplices(int dimension) const;
  Table faces(int dimension, int face_dimension) const;

  Id vertices_;
  mutable std::array<Table, 4> simplices_;
  mutable std::array<Table, relation_count> rows_;
};

}  // namespace gale::baselines
