#include <algorithm>

#include <gtest/gtest.h>

#include "relations/every_relation_mesh.hpp"
#include "relations/launched_batch.hpp"

namespace gale::test {

namespace {

/// For segments of at most so many rows; for stars it is too little.
BatchMemory memory_for(Id rows) {
  BatchMemory memory;
  memory.sizes.rows = rows;
  memory.sizes.star = memory.sizes.neighbours = 4 * rows;
  memory.sizes.slots = 8;
  memory.pool_words = 1000;
  return memory;
}

/// The rows of the segments that are there; how many are. No segment has some of its blocks only.
Id expect_rows(const LaunchedBatch& batch, const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  EXPECT_TRUE(batch.kept_to_the_pool()) << name_of(wanted);
  Id there = 0;
  for (Id s = 0; s < mesh.segments(); ++s) {
    EXPECT_TRUE(batch.has(s) || batch.lacks(s)) << "segment " << s << " has some of " << name_of(wanted);
    if (!batch.has(s)) continue;
    EXPECT_TRUE(expected.match(batch.rows(s), wanted));
    ++there;
  }
  return there;
}

/// What every segment of the mesh needs, found as a runtime does: by trying, from too little on.
BatchMemory memory_that_suffices(const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  BatchMemory memory = memory_for(4);
  for (int attempt = 0; attempt < 6; ++attempt) {
    const LaunchedBatch batch(mesh, wanted, memory);
    if (expect_rows(batch, mesh, wanted, expected) == mesh.segments()) return memory;
    EXPECT_TRUE(!memory.sizes.contains(batch.needed()) || batch.used() > memory.pool_words)
        << "some segments are missing, but nothing more was needed";
    memory.sizes = larger(memory.sizes, batch.needed());
    memory.pool_words = std::max(memory.pool_words, batch.used());
    memory.scratch_level = fits_level_0(mesh, wanted, memory.sizes, memory.warps) ? 0 : 1;
  }
  ADD_FAILURE() << "needs more and more for " << name_of(wanted);
  return memory;
}

}  // namespace

class LaunchedRowsOf : public EveryRelationMesh {};

TEST_P(LaunchedRowsOf, every_mesh_are_those_of_brute_force_whatever_the_scratch_memory) {
  for (const RelationSet wanted : kernels_for((all_relations | link_form))) {
    BatchMemory memory = memory_that_suffices(mesh, wanted, expected);
    memory.scratch_level = 1;
    memory.warps = 8;
    const LaunchedBatch batch(mesh, wanted, memory);
    EXPECT_EQ(expect_rows(batch, mesh, wanted, expected), mesh.segments());
    EXPECT_EQ(batch.needed().rows, 0) << "needs nothing more";
    EXPECT_LE(batch.used(), memory.pool_words);
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, LaunchedRowsOf, every_relation_mesh_and_segmentation(), mesh_and_segmentation);

TEST(LaunchedRows, leave_out_segments_of_more_rows_than_teams_have_scratch_memory_for_and_say_how_many) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2}));
  // Edges 01 02 03 04 12 13 23 24 25 have their lowest vertex in the first segment, 34 35 45 in the second.
  const LaunchedBatch batch(mesh, Relation::EF, memory_for(3));
  EXPECT_TRUE(batch.lacks(0));
  EXPECT_TRUE(batch.has(1));
  EXPECT_EQ(batch.needed().rows, 9);
  EXPECT_TRUE(LaunchedBatch(mesh, Relation::EF, memory_for(9)).has_all());
}

TEST(LaunchedRows, leave_out_what_the_pool_lacks_room_for_and_say_how_much_it_takes) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 7);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh, (all_relations | link_form));
  for (const RelationSet wanted : kernels_for((all_relations | link_form))) {
    const BatchMemory enough = memory_that_suffices(mesh, wanted, expected);
    BatchMemory less = enough;
    less.pool_words = enough.pool_words / 2;
    const LaunchedBatch batch(mesh, wanted, less);
    EXPECT_EQ(batch.used(), LaunchedBatch(mesh, wanted, enough).used());
    EXPECT_EQ(batch.needed().rows, 0) << "it is the pool that lacks, not the scratch memory";
    const Id there = expect_rows(batch, mesh, wanted, expected);
    EXPECT_GT(there, 0);
    EXPECT_LT(there, mesh.segments());
  }
}

}  // namespace gale::test
