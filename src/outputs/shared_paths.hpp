#pragma once

#include <gale/algorithms/separatrices.hpp>
#include <gale/base/memory.hpp>

namespace gale::outputs {

/// The simplices along paths of one kind, each with one number however many paths pass it. Between two cells, and
/// before the first, is a simplex of another dimension, which has a number among those between cells.
struct SharedPaths {
  Array<const Id, HostMemory> between;        ///< for each cell of the paths: the number of the simplex before it
  Array<const Id, HostMemory> cell;           ///< for each cell of the paths: its own number
  Array<const Id, HostMemory> first_between;  ///< by number: the place of the first cell that it precedes
  Array<const Id, HostMemory> first_cell;     ///< by number: the place of the first cell that it is
};

namespace detail {

/// Finds what paths have in common. Simplices between cells are one where they are the same behind the same cell, those
/// before first cells where the sources are: as along one gradient. Numbers are in the order in which paths pass the
/// simplices first. In parallel; 30 to 50 bytes a cell meanwhile. Throws gale::Error if ids can't number the cells.
template <class Cell>
SharedPaths share(const Separatrices<Cell>& paths);

}  // namespace detail

}  // namespace gale::outputs
