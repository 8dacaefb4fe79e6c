#pragma once

#include <array>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale.hpp>

#include "algorithms/brute_force_gradient.hpp"

namespace gale::test {

/// A Morse-Smale complex in which every simplex is named by its input vertices, so that it depends on no ids but the
/// user's. In the order of a MorseSmaleComplex.
struct NamedComplex {
  struct Path {
    Simplex source, destination;
    std::vector<Simplex> cells;
    bool is_only = true;

    auto all() const { return std::tie(source, destination, cells, is_only); }
    friend bool operator==(const Path& a, const Path& b) { return a.all() == b.all(); }
    friend bool operator<(const Path& a, const Path& b) { return a.all() < b.all(); }
  };

  struct Wall {
    Simplex source;
    std::vector<Simplex> cells;
    std::vector<std::vector<Simplex>> polygons;  ///< of ascending walls: the tetrahedra around each cell

    friend bool operator==(const Wall& a, const Wall& b) {
      return a.source == b.source && a.cells == b.cells && a.polygons == b.polygons;
    }
  };

  std::array<std::vector<Simplex>, 4> critical;
  std::vector<Path> descending, ascending, connectors;
  std::vector<Wall> descending_walls, ascending_walls;
  std::vector<Simplex> descending_manifold, ascending_manifold;  ///< of each vertex: its minimum, its maximum or none
  std::vector<Id> morse_smale_manifold;

  std::array<Id, 4> counts() const;
};

NamedComplex named(const MorseSmaleComplex& complex);

/// With the cells of walls and the tetrahedra of their polygons sorted, and no numbers for pairs of manifolds: all that
/// the definition of a complex determines.
NamedComplex as_defined(NamedComplex complex);

/// Are all parts the same? Says which isn't.
testing::AssertionResult equal(const NamedComplex& a, const NamedComplex& b);

/// Compares two complexes of one mesh, in GALE's ids: faster.
testing::AssertionResult equal(const MorseSmaleComplex& a, const MorseSmaleComplex& b);

}  // namespace gale::test
