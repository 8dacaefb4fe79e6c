#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/morse_smale/critical_places.hpp>

namespace gale::detail {

/// For each saddle the places of the two extrema that its paths end at; no_id for the outside of the mesh.
using PathEnds = std::vector<std::array<Id, 2>>;

/// The minima that the paths from the two vertices of each critical edge fall to.
PathEnds ends_of_edges(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The maxima that the paths from the tetrahedra of each critical triangle rise to. A triangle of one tetrahedron has
/// the outside on its other side; one of three or more has it on both. Paths don't fork here.
PathEnds ends_of_triangles(const DiscreteGradient& gradient, const CriticalPlaces& places);

/// The ends of all saddles' paths.
struct ExtremumEnds {
  PathEnds of_edges, of_triangles;
};

/// Whether a rising path forks: at a triangle of three tetrahedra or more.
bool forks(const DiscreteGradient& gradient);

}  // namespace gale::detail
