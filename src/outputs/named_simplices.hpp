#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/export.hpp>

namespace gale::outputs {

/// The edges and triangles that the outputs of a complex call by number: for `number_simplices`, whose answer the other
/// functions take. An edge or a triangle that several paths pass is there as often. In parallel.
///
/// - Edges: the critical ones; then one for each cell of `descending`, the edge that precedes that vertex on its path;
///   then one for each cell of `connectors`, the edge that precedes that triangle.
/// - Triangles: the critical ones; then one for each cell of `ascending`, the triangle that precedes that tetrahedron;
///   then the cells of `connectors` themselves.
///
/// On a triangle mesh there are edges alone: after those of `descending` one for each cell of `ascending`, the edge
/// that precedes that triangle.
GALE_EXPORT NamedSimplices named_simplices(const MorseSmaleComplex& complex);

namespace detail {

/// Where the groups of `named_simplices` begin. The critical ones begin at 0.
struct NamedGroups {
  explicit NamedGroups(const MorseSmaleComplex& complex)
      : descending_edges(complex.critical.edges.size()),
        connector_edges(descending_edges + complex.descending.cells.size()),
        ascending_edges(connector_edges + complex.connectors.cells.size()),
        ascending_triangles(complex.critical.triangles.size()),
        connector_triangles(ascending_triangles + complex.ascending.cells.size()) {}

  std::size_t descending_edges, connector_edges, ascending_edges;  ///< the last on a triangle mesh
  std::size_t ascending_triangles, connector_triangles;
};

}  // namespace detail

}  // namespace gale::outputs
