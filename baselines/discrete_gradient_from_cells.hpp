#pragma once

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/export.hpp>

namespace gale {

/// Finds the discrete gradient of `find_discrete_gradient`, pair by pair, as other programs compute it: they
/// collect the edges, triangles and tetrahedra of each vertex, keep those of its lower star, and pair these with two
/// priority queues. That asks for more relations and takes longer. It is there to compare how structures serve such
/// programs.
///
/// A sweep of VE, VF and VT, with rows of EV, FV and TV: from the mesh's tables, or from a structure that keeps them.
/// `structure` must be preconditioned for all six, and `order` be of its mesh: throws gale::Error otherwise. Nothing is
/// allocated for a vertex once the longest rows were seen.
GALE_EXPORT DiscreteGradient find_discrete_gradient_from_cells(Structure& structure, const VertexOrder& order,
                                                               const SweepOptions& options = {});

/// What it reads. FE and TF aren't needed, as the facets of a cell are found in the star by their vertices.
inline constexpr RelationSet discrete_gradient_from_cells_relations =
    Relation::VE | Relation::VF | Relation::VT | Relation::EV | Relation::FV | Relation::TV;

}  // namespace gale
