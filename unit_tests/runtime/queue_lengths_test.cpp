#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gale/runtime/make_structure.hpp>

#include "support/segmentations.hpp"

namespace gale::test {

TEST(QueueLengths, have_mean_median_and_deviation) {
  QueueLengths lengths;
  EXPECT_EQ(lengths.mean(), 0);
  EXPECT_EQ(lengths.median(), 0);
  EXPECT_EQ(lengths.deviation(), 0);
  for (const std::size_t length : {2, 4, 4, 4, 5, 5, 7, 9}) lengths.add(length);
  EXPECT_EQ(lengths.mean(), 5);
  EXPECT_EQ(lengths.median(), 4);
  EXPECT_EQ(lengths.deviation(), 2);
  EXPECT_EQ(lengths.times, (std::vector<std::int64_t>{0, 0, 1, 0, 3, 2, 0, 1, 0, 1}));
}

TEST(QueueLengths, of_a_leader_count_every_request_once) {
  const Mesh mesh = encode(holed_grid(8), 20);
  StructureOptions options;
  options.way = Way::leaders;
  options.host_memory = 1;  // nothing stays
  const auto structure = make_structure(mesh, Relation::VV, options);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      const auto consumer = structure->consumer();
      for (Id v = i; v < mesh.vertices(); v += 17) consumer->row(Relation::VV, v);
    });
  }
  for (auto& thread : threads) thread.join();
  const auto statistics = structure->statistics();
  std::int64_t waited = 0;
  for (std::size_t length = 0; length < statistics.leaders.at(0).queue_lengths.times.size(); ++length) {
    waited += static_cast<std::int64_t>(length) * statistics.leaders[0].queue_lengths.times[length];
  }
  EXPECT_GT(waited, 0);
  EXPECT_EQ(waited, statistics.all_consumers().requests);
}

}  // namespace gale::test
