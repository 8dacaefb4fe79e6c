#include <algorithm>
#include <deque>

#include <gtest/gtest.h>

#include <gale/runtime/batches/batch_lane.hpp>
#include <gale/runtime/leaders/batch_worker.hpp>

#include "support/brute_force.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

using detail::BatchPlan;
using detail::BatchShortfall;
using Lane = detail::BatchLane<WorkerMemory>;

constexpr int threads_per_segment = 128;

struct LaunchedMesh {
  const InputMesh& input = mesh_named("holed_grid_9");
  Mesh mesh = encode(input, 7);
  ExpectedRows expected{input, brute_force_of("holed_grid_9"), mesh, all_relations | link_form};

  /// How many segments of a batch have other rows than those expected; none of those that are missing.
  int wrong(const Batch<HostMemory>& batch, std::vector<int>& made) const {
    int wrong = 0;
    for (Id slot = 0; slot < batch.count; ++slot) {
      if (!batch.has(slot)) continue;
      ++made[batch.segments[slot]];
      SegmentRows rows(batch.segments[slot], mesh.intervals_of(batch.segments[slot]));
      add_rows(batch, slot, rows);
      wrong += !expected.match(rows, batch.relations);
    }
    return wrong;
  }

  /// Has a lane make all segments, first all together, and tries again what it lacked. Returns how many batches it
  /// took.
  int make_all(RelationSet wanted, Offset room, std::size_t most_fast) const {
    const auto kernels = std::make_shared<Lane::Kernels>();
    kernels->emplace_back(mesh, wanted, threads_per_segment, most_fast);
    Lane lane(mesh, kernels, room, detail::BatchReader::host);
    std::deque<BatchPlan> plans(1);
    plans[0].end = mesh.segments();
    plans[0].words = room;
    std::vector<int> made(mesh.segments());
    int batches = 0;
    for (; !plans.empty(); ++batches) {
      const PinnedArray<Id> words(plans[0].words);
      lane.launch(plans[0]);
      EXPECT_TRUE(lane.in_flight());
      lane.begin_copy(words);
      const BatchShortfall lacked = lane.finish();
      std::vector<Id> segments(plans[0].count());
      for (std::size_t slot = 0; slot < segments.size(); ++slot) segments[slot] = lane.segment(static_cast<Id>(slot));
      EXPECT_EQ(
          wrong({wanted, plans[0].count(), segments.data(), lane.directory(), words.data(), interval_tables(mesh)},
                made),
          0);
      for (const Id segment : lacked.segments) EXPECT_EQ(made[segment], 0);
      for (BatchPlan& half : detail::in_halves(plans[0], lacked)) plans.push_back(std::move(half));
      plans.pop_front();
    }
    EXPECT_EQ(std::count(made.begin(), made.end(), 1), mesh.segments());
    return batches;
  }
};

constexpr std::size_t all_of_it = std::numeric_limits<std::size_t>::max();

}  // namespace

TEST(BatchPlan, has_what_was_lacking_tried_again_in_halves) {
  BatchPlan plan;
  plan.begin = 10;
  plan.end = 20;
  plan.words = 100;
  BatchShortfall lacked;
  lacked.segments = {12, 13, 17};
  lacked.words = 400;
  lacked.scratch = {{7, 0, 0, 0, 0, 0}};
  const auto halves = in_halves(plan, lacked);
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_EQ(halves[0].segments, (std::vector<Id>{12, 13}));
  EXPECT_EQ(halves[1].segments, (std::vector<Id>{17}));
  for (const BatchPlan& half : halves) {
    EXPECT_EQ(half.words, 100);
    ASSERT_EQ(half.scratch.size(), 1u);
    EXPECT_EQ(half.scratch[0].rows, 7);
  }
}

TEST(BatchPlan, has_one_segment_tried_again_with_the_room_that_it_needs) {
  BatchPlan plan;
  plan.segments = {5};
  plan.words = 100;
  plan.scratch = {{3, 9, 0, 0, 0, 0}};
  BatchShortfall lacked;
  lacked.segments = {5};
  lacked.words = 400;
  lacked.scratch = {{7, 2, 0, 0, 0, 0}};
  const auto again = in_halves(plan, lacked);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].words, 400);
  EXPECT_EQ(again[0].scratch[0].rows, 7);
  EXPECT_EQ(again[0].scratch[0].star, 9);
}

TEST(BatchPlan, lacks_everything_if_it_cannot_be_launched) {
  BatchPlan plan;
  plan.begin = 3;
  plan.end = 6;
  EXPECT_EQ(detail::all_of(plan).segments, (std::vector<Id>{3, 4, 5}));
}

TEST(BatchLane, makes_each_segment_whatever_the_room) {
  const LaunchedMesh of;
  for (const RelationSet wanted : {star_relations, RelationSet(Relation::EF), RelationSet(Relation::TT)}) {
    EXPECT_EQ(of.make_all(wanted, 1 << 20, all_of_it), 1);
    EXPECT_GT(of.make_all(wanted, 1000, all_of_it), 3);
    EXPECT_GT(of.make_all(wanted, 4, all_of_it), of.mesh.segments());
  }
}

TEST(BatchLane, gives_large_segments_the_scratch_memory_that_they_need) {
  const LaunchedMesh of;
  const SegmentKernel<WorkerMemory> kernel(of.mesh, star_relations);
  const std::size_t of_the_first = kernel.scratch_bytes(kernel.bound(0), is_device<WorkerSpace> ? 4 : 1);
  for (const std::size_t fast : {std::size_t(0), of_the_first}) {
    const detail::BatchKernel<WorkerMemory> limited(of.mesh, star_relations, threads_per_segment, fast);
    Id large = 0;
    for (Id segment = 0; segment < of.mesh.segments(); ++segment) large += limited.is_large(segment);
    EXPECT_GT(large, 0);
    EXPECT_EQ(large == of.mesh.segments(), fast == 0);
    EXPECT_EQ(of.make_all(star_relations, 1 << 20, fast), 1);
    EXPECT_GT(of.make_all(star_relations, 1000, fast), 3);
  }
}

TEST(LaunchedWorker, fills_arenas_as_that_of_the_host_does) {
  const LaunchedMesh of;
  const detail::WorkerParameters parameters{star_relations, 2000, threads_per_segment};
  const std::unique_ptr<detail::BatchWorker> workers[] = {
      detail::make_host_worker(of.mesh, parameters), detail::make_launched_worker<WorkerMemory>(of.mesh, parameters)};
  for (const auto& worker : workers) {
    for (const Offset words : {Offset(2000), Offset(1) << 16}) {
      detail::Arena arena;
      arena.words = PinnedArray<Id>(words);
      BatchPlan plan;
      for (Id segment = of.mesh.segments(); segment-- > 0;) plan.segments.push_back(segment);
      plan.words = words;
      worker->launch(plan);
      worker->begin_copy(arena);
      const BatchShortfall lacked = worker->finish(arena);
      std::vector<int> made(of.mesh.segments());
      EXPECT_EQ(of.wrong(arena.batch(star_relations, interval_tables(of.mesh)), made), 0);
      for (const Id segment : lacked.segments) ++made[segment];
      EXPECT_EQ(std::count(made.begin(), made.end(), 1), of.mesh.segments());
      EXPECT_EQ(lacked.segments.empty(), lacked.words <= words);
      EXPECT_EQ(worker->device_bytes() > 0, have_device && worker == workers[1]);
    }
  }
}

}  // namespace gale::test
