#pragma once

#include <array>
#include <functional>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>
#include <gale/algorithms/persistence.hpp>

namespace gale::detail {

/// The critical simplices of a gradient in the order in which the mesh is built up: each dimension by the keys of its
/// simplices' vertices, from the highest to the lowest. Cells are of the mesh's dimension.
struct Filtration {
  std::array<std::vector<Id>, 4> by_rank;  ///< places in CriticalSimplices
  std::array<std::vector<Id>, 4> rank;     ///< of each place
};
Filtration filtration_of(const DiscreteGradient& gradient, int threads);

/// The highest vertex of a cell, in GALE's ids.
Id highest_corner(const DiscreteGradient& gradient, Id cell);

/// The value of each critical simplex of a gradient, which is that of its highest vertex, by dimension.
using CriticalValues = std::array<std::vector<double>, 4>;

/// `value(v)` is the field at an input vertex. Throws gale::Error, naming the vertex, if it is NaN.
CriticalValues critical_values(const DiscreteGradient& gradient, const std::function<double(Id)>& value);

/// The pairs of a type whose persistence is below a threshold, the least persistent first; of equals that of the first
/// lower simplex.
std::vector<PersistencePair> pairs_below(double threshold, int type, const std::vector<PersistencePair>& pairs,
                                         const CriticalValues& values);

/// For each saddle the places of the two extrema that its paths end at; no_id for the outside of the mesh.
using PathEnds = std::vector<std::array<Id, 2>>;

/// The minima that the paths from the two vertices of each critical edge fall to.
PathEnds ends_of_edges(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The maxima that the paths from the cells of each critical facet of cells rise to: of each critical triangle, or on a
/// triangle mesh of each critical edge. A facet of one cell has the outside on its other side; one of three or more has
/// it on both. Paths don't fork here.
PathEnds ends_of_facets(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The ends of all saddles' paths.
struct ExtremumEnds {
  PathEnds of_edges, of_facets;
};

/// Which pairs are wanted: those of minima and maxima take little, those of saddles with one another the most.
enum class WantedPairs { of_extrema, all };

/// Pairs the critical simplices of a gradient with such ends. With `forks` as `find_persistence_pairs` does, and then
/// nothing asks for the ends of facets. Without, rising paths don't fork: at a facet of three cells or more they take
/// the way that `cell_successor` has, and such a facet is paired with no maximum. So each pair with a maximum can be
/// cancelled. The same where no facet has three. What isn't wanted is in no pair.
PersistencePairs pairs_of(const DiscreteGradient& gradient, const CriticalPlaces& places, const ExtremumEnds& ends,
                          bool forks, WantedPairs wanted, int threads);

/// Whether a rising path forks: at a triangle of three tetrahedra or more, or on a triangle mesh at such an edge.
bool has_forks(const DiscreteGradient& gradient);

/// The pairs of saddles with extrema, from which those of saddles with saddles follow.
class PairsOfExtrema {
 public:
  /// Pairs the saddles of a mesh of that dimension, whose paths have these ends. `forked_maxima` finds for each maximum
  /// the saddle that it is paired with, where paths fork; empty where they don't.
  PairsOfExtrema(const Filtration& filtration, const ExtremumEnds& ends, int dimension,
                 const std::function<std::vector<Id>()>& forked_maxima = {});

  /// The 2-saddles that no maximum is paired with, in the order of the filtration; none on a triangle mesh.
  const std::vector<Id>& columns() const { return columns_; }

  /// All pairs, given for each 1-saddle the 2-saddle that it is paired with, no_id if it is with none.
  PersistencePairs with_saddles(const std::vector<Id>& upper_of_lower);

 private:
  std::vector<PersistencePair> from_lower(int dimension, const std::vector<Id>& upper);
  std::vector<PersistencePair> from_upper(int dimension, const std::vector<Id>& lower);

  const int dimension_;
  std::array<std::vector<char>, 4> is_paired_;
  PersistencePairs found_;
  std::vector<Id> columns_;
};

/// For each maximum the saddle that it is paired with, no_id if it is with none, whatever rising paths do: where they
/// fork, a saddle has more ends than two, and sets of extrema can't tell. By elimination over Z2. For meshes with
/// facets of three cells and more, which are no part of space, and no surfaces: sequential, and up to cubic.
std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration);

}  // namespace gale::detail
