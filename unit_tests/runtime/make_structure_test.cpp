#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/baselines/task_parallel_structure.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/brute_force.hpp"
#include "support/full_device.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

TEST(Way, has_one_name) {
  for (const Way way : {Way::gale, Way::leaders, Way::helpers, Way::inline_, Way::explicit_}) {
    EXPECT_EQ(way_named(name_of(way)), way);
  }
  EXPECT_STREQ(name_of(Way::inline_), "inline");
  EXPECT_EQ(way_named("pairs"), std::nullopt);
}

TEST(MakeStructure, says_which_way_it_took) {
  const Mesh mesh = encode(mesh_named("the_papers"), 2);
  for (const Way way : {Way::leaders, Way::helpers, Way::inline_}) {
    StructureOptions options;
    options.way = way;
    const auto structure = make_structure(mesh, Relation::VV, options);
    EXPECT_EQ(structure->way(), way);
    EXPECT_EQ(structure->name(), name_of(way));
  }
  EXPECT_EQ(baselines::make_task_parallel_structure(mesh, Relation::VV)->name(), "task-parallel");
  const auto structure = make_structure(mesh, Relation::VV);
  EXPECT_EQ(structure->way(), have_device ? Way::leaders : Way::helpers);
  EXPECT_TRUE(structure->statistics().notices.empty());
}

TEST(MakeStructure, wants_a_relation) {
  const Mesh mesh = encode(mesh_named("the_papers"), 2);
  EXPECT_EQ(message_of([&] { make_structure(mesh, {}); }),
            "a structure needs at least one relation to be preconditioned for");
}

TEST(MakeStructure, wants_relations_that_the_mesh_has) {
  const Mesh plane(Grid({3, 3, 1}), 4);
  const auto message = message_of([&] { make_structure(plane, Relation::VT); });
  EXPECT_EQ(message.substr(0, message.find(':')), "a mesh of triangles has no relation VT");
  EXPECT_EQ(message_of([&] { baselines::make_task_parallel_structure(plane, Relation::VT); }), message);
}

TEST(MakeStructure, has_the_host_compute_where_the_device_is_full) {
  if (!have_device) GTEST_SKIP() << "there is no device";
  const InputMesh& input = mesh_named("holed_grid_9");
  const ExpectedRows* expected = nullptr;
  for (const bool mesh_fits : {true, false}) {
    std::unique_ptr<const Mesh> mesh;
    if (mesh_fits) mesh = std::make_unique<const Mesh>(encode(input, 7));
    const FullDevice full(0);
    if (!mesh_fits) mesh = std::make_unique<const Mesh>(encode(input, 7));
    const ExpectedRows rows(input, brute_force_of("holed_grid_9"), *mesh);
    expected = &rows;
    const auto structure = make_structure(*mesh, star_relations);
    int wrong = 0;
    SweepOptions options;
    options.threads = 1;
    structure->for_each_segment(star_relations, options, [&](int, const SegmentRows& found) {
      wrong += !expected->match(found, star_relations);
    });
    EXPECT_EQ(wrong, 0);
    const auto notices = structure->statistics().notices;
    ASSERT_FALSE(notices.empty());
    EXPECT_NE(notices.front().find("fit the device's memory"), std::string::npos) << notices.front();
  }
}

}  // namespace gale::test
