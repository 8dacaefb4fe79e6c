#pragma once

#include <gtest/gtest.h>

#include <set>

#include <gale/relations/segment_rows.hpp>

#include "support/input_mesh.hpp"

namespace gale::test {

/// What touches what, from the input alone, by sets and maps; in input ids.
struct BruteForce {
  std::vector<std::set<Id>> vv, vt;
  std::vector<std::uint8_t> on_boundary;  ///< per vertex: 1 if some triangle of it has exactly one tetrahedron

  explicit BruteForce(const InputMesh& mesh);
};

/// The same of one of `mesh_names()`; computed at the first call.
const BruteForce& brute_force_of(const std::string& mesh_name);

/// What the rows of a mesh must be, in GALE's ids. It trusts the mesh' permutations and nothing else of it.
struct ExpectedRows {
  std::vector<std::vector<Id>> vv, vt;
  std::vector<std::vector<std::array<Id, 3>>> link;

  ExpectedRows(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh);

  /// Are these the rows of the segment's vertices, in the relations wanted? Says where they aren't.
  testing::AssertionResult match(const SegmentRows& rows, RelationSet wanted) const;
};

}  // namespace gale::test
