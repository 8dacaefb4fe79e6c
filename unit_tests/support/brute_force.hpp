#pragma once

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <gale/baselines/brute_force.hpp>
#include <gale/relations/segment_rows.hpp>

#include "support/expected_simplices.hpp"
#include "support/input_mesh.hpp"

namespace gale::test {

/// What touches what, from the input alone, in input ids.
struct BruteForce : baselines::BruteForce {
  explicit BruteForce(const InputMesh& mesh);

  Table vv, vt;
  std::vector<std::uint8_t> on_surface;  ///< per vertex: 1 if some triangle of it has exactly one tetrahedron
};

/// What touches what in one of `mesh_names()`; computed at the first call.
const BruteForce& brute_force_of(const std::string& mesh_name);

/// What the rows of a mesh must be, in GALE's ids. It trusts the mesh's permutations and vertex_begin(), which
/// mesh_test.cpp checks, and nothing else of it.
class ExpectedRows {
 public:
  using Table = BruteForce::Table;
  using Links = std::vector<std::vector<std::array<Id, 3>>>;

  /// Expects the rows of `relations` alone.
  ExpectedRows(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh,
               RelationSet relations = star_relations);
  ExpectedRows(const ExpectedRows&) = delete;
  ExpectedRows& operator=(const ExpectedRows&) = delete;

  const Table& operator[](Relation relation) const { return rows_[static_cast<int>(relation)]; }

  /// Are these the rows of the segment's simplices, in the relations wanted, and are the simplices it says it has those
  /// whose lowest vertex it holds? Says where they aren't. By any number of threads.
  testing::AssertionResult match(const SegmentRows& rows, RelationSet wanted) const;

  /// Is this the row of a simplex?
  testing::AssertionResult match(Relation relation, Id simplex, const Row& row) const;
  testing::AssertionResult match(Id vertex, const LinkRow& row) const;

 private:
  void find_links(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh);
  testing::AssertionResult match_intervals(const SegmentRows& rows, RelationSet wanted) const;

  ExpectedSimplices simplices_;
  std::array<Table, relation_count> rows_;

 public:
  const Table& vv = rows_[static_cast<int>(Relation::VV)];
  const Table& vt = rows_[static_cast<int>(Relation::VT)];
  Links link;
};

}  // namespace gale::test
