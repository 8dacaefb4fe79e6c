#pragma once

#include <gale/algorithms/discrete_gradient.hpp>

namespace gale {

/// The same discrete gradient as `find_discrete_gradient`, pair by pair, in the formulation of other programs: of each
/// vertex' edges, triangles and tetrahedra, by their vertices, those of its lower star are collected and paired with
/// two priority queues. It asks for more relations and takes longer; it is there to compare structures by what they
/// give to such programs.
///
/// A sweep of VE, VF and VT, with rows of EV, FV and TV: from the mesh' tables, or from a structure that keeps them.
/// `structure` must be preconditioned for all six, and `order` be of its mesh: throws gale::Error otherwise. Nothing is
/// allocated for a vertex once the longest rows were seen.
DiscreteGradient find_discrete_gradient_from_cells(Structure& structure, const VertexOrder& order,
                                                   const SweepOptions& options = {});

/// What it reads. The facets of a cell are found in the star by their vertices, so that FE and TF aren't needed.
inline constexpr RelationSet discrete_gradient_from_cells_relations =
    Relation::VE | Relation::VF | Relation::VT | Relation::EV | Relation::FV | Relation::TV;

}  // namespace gale
