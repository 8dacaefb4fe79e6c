#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/export.hpp>

namespace gale::outputs {

/// The simplices along paths of one kind, each with one number however many paths pass it. Between two cells, and
/// before the first, is a simplex of another dimension, which has a number among those between cells.
struct SharedPaths {
  Array<const Id, HostMemory> between;        ///< for each cell of the paths: the number of the simplex before it
  Array<const Id, HostMemory> cell;           ///< for each cell of the paths: its own number
  Array<const Id, HostMemory> first_between;  ///< by number: the place of the first cell that it precedes
  Array<const Id, HostMemory> first_cell;     ///< by number: the place of the first cell that it is
};

/// The edges and triangles that the outputs of a complex call by number, for `number_simplices`, and what its paths
/// have in common.
///
/// - Edges: the critical ones; then those that precede vertices on `descending` paths; then those that precede
///   triangles on `connectors`.
/// - Triangles: the critical ones; then those that precede tetrahedra on `ascending` paths; then the cells of
///   `connectors` themselves.
///
/// On a triangle mesh there are edges alone: after those of `descending` the ones that precede triangles on `ascending`
/// paths. Those of each kind are in the order of their numbers in SharedPaths.
struct NamedPaths : NamedSimplices {
  SharedPaths descending;  ///< what the paths of `descending` have in common
  SharedPaths ascending;   ///< what those of `ascending` have
  SharedPaths connectors;  ///< what `connectors` have
};

/// Names what a complex's paths pass, in parallel. Throws gale::Error if there are more than 2^31 - 1 cells of a
/// kind, and what making the complex's excerpt does.
GALE_EXPORT NamedPaths named_simplices(const MorseSmaleComplex& complex);

namespace detail {

/// Where the groups of named simplices begin. The critical ones begin at 0.
struct NamedGroups {
  NamedGroups(const MorseSmaleComplex& complex, const NamedPaths& named)
      : descending_edges(complex.critical.edges.size()),
        connector_edges(descending_edges + named.descending.first_between.extent(0)),
        ascending_edges(connector_edges + named.connectors.first_between.extent(0)),
        ascending_triangles(complex.critical.triangles.size()),
        connector_triangles(ascending_triangles + named.ascending.first_between.extent(0)) {}

  std::size_t descending_edges, connector_edges, ascending_edges;  ///< the last on a triangle mesh
  std::size_t ascending_triangles, connector_triangles;
};

}  // namespace detail

}  // namespace gale::outputs
