#include <algorithm>

#include <gtest/gtest.h>

#include <gale/base/stop.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/runtime/relation_of.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

namespace {

using Table = BruteForce::Table;

Table to_table(const Csr<const Id, HostMemory>& rows) {
  Table table;
  for (Offset i = 0; i < rows.rows(); ++i) table.emplace_back(rows.row(i).begin(), rows.row(i).end());
  return table;
}

/// Rows in GALE's ids, in the input's.
Table in_input(const Mesh& mesh, Relation relation, const Table& rows) {
  const auto row_numbers = input_numbers(mesh, row_dimension(relation)),
             entry_numbers = input_numbers(mesh, entry_dimension(relation));
  Table table(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = table[row_numbers(i)] = rows[i];
    for (Id& id : row) id = entry_numbers(id);
    std::sort(row.begin(), row.end());
  }
  return table;
}

Relation the_other_way(Relation relation) {
  const auto all = members_of(all_relations);
  return *std::find_if(all.begin(), all.end(), [&](Relation one) {
    return row_dimension(one) == entry_dimension(relation) && entry_dimension(one) == row_dimension(relation);
  });
}

}  // namespace

class RelationOf : public EveryMesh {};

TEST_P(RelationOf, every_mesh_has_the_rows_of_brute_force) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh, all_relations);
  int threads = 3;
  for (const Relation relation : members_of(all_relations)) {
    EXPECT_EQ(to_table(relation_of(mesh, relation, Ids::gale, with_threads(threads))), expected[relation])
        << name_of(relation);
    threads = 4 - threads;  // one and three in turn
    EXPECT_EQ(to_table(relation_of(mesh, relation, Ids::input, with_threads(threads))),
              in_input(mesh, relation, expected[relation]))
        << name_of(relation);
    if (row_dimension(relation) > entry_dimension(relation)) {
      EXPECT_EQ(to_table(detail::kernel_rows(HostExecutionSpace(), mesh, relation, false, {})), expected[relation])
          << name_of(relation);
      EXPECT_EQ(to_table(detail::kernel_rows(HostExecutionSpace(), mesh, relation, true, {})),
                expected[the_other_way(relation)])
          << name_of(relation);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, RelationOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

TEST(RelationOfPart, has_no_rows_of_ghosts) {
  const InputMesh& input = mesh_named("holed_grid_9");
  Segmentation segmentation = octree_of(input, 20);
  const Mesh whole = encode(input, segmentation);
  segmentation.owned_segments = segmentation.segments() / 2;
  const Mesh part = encode(input, segmentation);
  for (const Relation relation : members_of(all_relations)) {
    Table expected = to_table(relation_of(whole, relation, Ids::gale));
    const auto& begin = part.interval_begin(row_dimension(relation));
    for (std::size_t i = begin(part.owned_segments().last); i < expected.size(); ++i) expected[i].clear();
    EXPECT_EQ(to_table(relation_of(part, relation, Ids::gale)), expected) << name_of(relation);
  }
}

TEST(RelationOfMesh, tells_how_far_it_is_and_stops) {
  const Mesh mesh = encode(mesh_named("holed_grid_9"), 20);
  for (const Relation relation : {Relation::VV, Relation::TV, Relation::EE}) {
    Id done = 0, all = no_id;
    SweepOptions options = with_threads(2);
    options.progress = [&](Id now, Id segments) {
      done = now;
      all = segments;
    };
    relation_of(mesh, relation, Ids::input, options);
    EXPECT_EQ(done, all) << name_of(relation);
    StopRequest request;
    const StopScope stoppable(&request);
    request.stop();
    EXPECT_THROW(relation_of(mesh, relation, Ids::input, options), Stopped);
  }
}

TEST(RelationOfMesh, refuses_less_than_one_thread) {
  const Mesh mesh = encode(mesh_named("the_papers"), 20);
  EXPECT_EQ(message_of([&] { relation_of(mesh, Relation::EV, Ids::input, with_threads(0)); }),
            "threads is 0, not 1 to 1024");
}

}  // namespace gale::test
