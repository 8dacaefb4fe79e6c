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

/// For each maximum the saddle that it is paired with, no_id if it is with none, whatever rising paths do: where they
/// fork, a saddle has more ends than two, and sets of extrema can't tell. By elimination over Z2. For meshes with
/// facets of three cells and more, which are no part of space, and no surfaces: sequential, and up to cubic.
std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration);

/// Pairs 1-saddles with 2-saddles: for each 1-saddle the 2-saddle that it is paired with, no_id if it is with none.
/// `columns` are the 2-saddles to pair, in the order of the filtration: those that no maximum is paired with.
///
/// Elimination by columns. Each 2-saddle's rim falls until its highest edge is a 1-saddle (EdgeChain). If an earlier
/// 2-saddle has met that one, its rim is added, and both fall on; if a later one has, that one goes on instead, with
/// both rims (Morozov, Nigmetov, "Towards lockfree persistent homology", 2020). So threads needn't wait for each other,
/// and the pairs are the same whatever their number.
std::vector<Id> pair_saddles(const DiscreteGradient& gradient, const CriticalPlaces& places,
                             const Filtration& filtration, const std::vector<Id>& columns, int threads);

}  // namespace gale::detail
