#pragma once

#include <gale/outputs/named_simplices.hpp>

namespace gale::outputs::detail {

/// Finds what paths have in common. Simplices between cells are one where they are the same behind the same cell, those
/// before first cells where the sources are: as along one gradient. Numbers are in the order in which paths pass the
/// simplices first. In parallel; up to 17 bytes a cell meanwhile, of which 16 are the result. Throws gale::Error if ids
/// can't number the cells.
template <class Cell>
SharedPaths share(const Separatrices<Cell>& paths);

}  // namespace gale::outputs::detail
