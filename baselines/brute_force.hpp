#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <gale/export.hpp>
#include <gale/relations/relation.hpp>

namespace gale::baselines {

/// What touches what among some tetrahedra, or triangles: it lists all simplices and searches the lists, slow and
/// simple, without any code of the kernels. Other edges and triangles are numbered as their vertices, which ascend,
/// compare.
class GALE_EXPORT BruteForce {
 public:
  using Table = std::vector<std::vector<Id>>;  ///< ascending ids, by simplex

  /// Vertices 0 to `vertices` - 1, and cells whose corners come in any order: tetrahedra, or triangles. Both keep their
  /// numbers.
  template <std::size_t corners>
  BruteForce(Id vertices, std::vector<std::array<Id, corners>> cells)
      : vertices_(vertices), dimension_(static_cast<int>(corners) - 1) {
    for (auto& cell : cells) {
      std::sort(cell.begin(), cell.end());
      simplices_[dimension_].emplace_back(cell.begin(), cell.end());
    }
  }

  /// The vertices of all simplices of a dimension. Found at the first call; this and `rows` by one thread at a time.
  const Table& simplices(int dimension) const;

  /// The rows of a relation. Found at the first call.
  const Table& rows(Relation relation) const;

 private:
  Table find_simplices(int dimension) const;
  Table faces(int dimension, int face_dimension) const;

  Id vertices_;
  int dimension_;  ///< of the cells
  mutable std::array<Table, 4> simplices_;
  mutable std::array<Table, relation_count> rows_;
};

}  // namespace gale::baselines
