#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

/// Stands for a key that a table has.
struct IsSeen {};

template <class T>
using FoundList = std::vector<T>;

/// What a rank has found for one that asks, and where it has been for it. Vertices are called by GALE's ids, until all
/// are known.
struct FoundFor : ReachedLists<FoundList> {
  std::vector<Id> more_vertices;  ///< that no simplex has
  HashTable<Id> cell_places;
  HashTable<IsSeen> fallen_vertices, fallen_edges, told_edges, risen_cells, risen_edges;
};

/// What a rank has found for all that ask.
class FoundForRanks {
 public:
  explicit FoundForRanks(const VertexOrder& order) : order_(order), found_(order.mesh().exchange().ranks().size()) {}

  FoundFor& operator[](int asker) { return found_[asker]; }

  /// Has nothing for one of them.
  void forget(int asker);

  /// Has all call vertices by their places in the lists of vertices, which it makes.
  void number_vertices();

  /// How many bytes were found for each rank, once vertices are numbered.
  std::vector<std::int64_t> bytes();

  /// Sends it to those who have asked. Collective.
  Reached send();

 private:
  void number_vertices(FoundFor& found) const;

  const VertexOrder& order_;
  std::vector<FoundFor> found_;
};

}  // namespace gale::detail
