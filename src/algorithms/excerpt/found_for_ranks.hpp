#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

/// Stands for a key that a table has.
struct IsSeen {};

template <class T>
using FoundList = std::vector<T>;

/// What a rank has found for one that asks. Vertices are called by GALE's ids, until all are known.
struct FoundFor : ReachedLists<FoundList> {
  std::vector<Id> more_vertices;  ///< that no simplex has
  HashTable<Id> cell_places;

  /// The place of a cell among `cells`, where it is put if it isn't there yet.
  Id place_of(Id cell, const CellReader& corners_of, const PathSimplices& simplices) {
    const auto [place, is_new] = cell_places.insert(static_cast<std::uint64_t>(cell));
    if (is_new) {
      place = static_cast<Id>(cells.size());
      const Quad corners = corners_of(cell);
      cells.push_back({simplices.global(cell), {corners.a, corners.b, corners.c, corners.d}});
    }
    return place;
  }

  /// Adds the step from a cell to its successor, or of one that has none; returns the cell's place.
  Id add_step(Id cell, Id next, const CellReader& corners_of, const PathSimplices& simplices) {
    const Id place = place_of(cell, corners_of, simplices);
    cell_steps.push_back({place, step_to(next, [&](Id one) { return place_of(one, corners_of, simplices); })});
    return place;
  }

  /// Has these steps, of cells by their ids, and no others: instead of add_step() and place_of().
  void set_cell_steps(std::vector<std::array<Id, 2>> steps, const CellReader& corners_of,
                      const PathSimplices& simplices);

 private:
  /// What a step says of a cell's successor, which may be outside or none.
  template <class PlaceOf>
  static Id step_to(Id next, const PlaceOf& place_of) {
    if (next >= 0) return place_of(next);
    return next == no_id ? no_id : step_outside(corner_outside(next));
  }
};

/// What a rank has found for all that ask.
class FoundForRanks {
 public:
  explicit FoundForRanks(const VertexOrder& order) : order_(order), found_(order.mesh().exchange().ranks().size()) {}

  FoundFor& operator[](int asker) { return found_[asker]; }

  /// Has all call vertices by their places in the lists of vertices, which it makes.
  void number_vertices();

  /// How many bytes were found for each rank, once vertices are numbered.
  std::vector<std::int64_t> bytes() const;

  /// Sends it to those who have asked. Collective.
  Reached send();

 private:
  void number_vertices(FoundFor& found) const;

  const VertexOrder& order_;
  std::vector<FoundFor> found_;
};

}  // namespace gale::detail
