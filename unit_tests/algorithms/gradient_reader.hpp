#pragma once

#include <array>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>

#include "algorithms/brute_force_gradient.hpp"
#include "support/brute_force.hpp"

namespace gale::test {

/// What a simplex is paired with: one of another dimension (-1: none), that has one vertex (input id) more or less.
struct Pair {
  int dimension;
  Id vertex;

  friend bool operator==(const Pair& a, const Pair& b) { return a.dimension == b.dimension && a.vertex == b.vertex; }
  friend bool operator!=(const Pair& a, const Pair& b) { return !(a == b); }
};

/// The pair of each simplex, by dimension and BruteForce's number.
using PairTable = std::array<std::vector<Pair>, 4>;

PairTable pairs_of(const BruteForceGradient& gradient, const BruteForce& simplices);

/// Asks a DiscreteGradient for all that it knows, simplex by simplex, in input ids.
class GradientReader {
 public:
  /// Both must outlive it.
  GradientReader(const BruteForce& simplices, const Mesh& mesh);

  PairTable pairs(const DiscreteGradient& gradient) const;

  /// Are these the pairs, and do successors, critical simplices and whatever else can be asked say the same? Says where
  /// they don't.
  testing::AssertionResult match(const DiscreteGradient& gradient, const PairTable& expected) const;

  /// Do two gradients hold the same? Faster.
  testing::AssertionResult equal(const DiscreteGradient& a, const DiscreteGradient& b) const;

 private:
  /// A triangle as a face of one of its tetrahedra, in GALE's ids.
  struct Side {
    Id tetrahedron;
    int corner;  ///< opposite
    std::vector<Id> others;
  };

  Pair in_input_ids(const Partner& partner) const;
  Pair pair_of_triangle(const DiscreteGradient& gradient, const Side& side) const;
  testing::AssertionResult match_pairs(const DiscreteGradient& gradient, const PairTable& expected) const;
  testing::AssertionResult match_triangles_of_edges(const DiscreteGradient& gradient, const PairTable& expected) const;
  testing::AssertionResult match_sides(const DiscreteGradient& gradient, const PairTable& expected) const;
  testing::AssertionResult match_successors(const DiscreteGradient& gradient, const PairTable& expected) const;
  testing::AssertionResult match_critical(const DiscreteGradient& gradient, const PairTable& expected) const;

  const BruteForce& simplices_;
  const Mesh mesh_;
  std::vector<Id> tetrahedron_;                       ///< by input id: GALE's
  std::array<std::vector<std::vector<Id>>, 4> gale_;  ///< vertices of each simplex but tetrahedra, in GALE's ids
  std::vector<std::vector<Side>> sides_;              ///< of each triangle
  std::vector<std::map<Id, Id>>
      across_;  ///< by tetrahedron: without a vertex of it, the lowest other that has the rest
};

}  // namespace gale::test
