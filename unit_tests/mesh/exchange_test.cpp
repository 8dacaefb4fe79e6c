#include <gtest/gtest.h>

#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/home_table.hpp>
#include <gale/mesh/exchange/places.hpp>

#include "support/arrays.hpp"
#include "support/input_mesh.hpp"
#include "support/segmentations.hpp"

// What a whole mesh asks of others: nothing.

namespace gale::test {

namespace {

using Ids = std::vector<GlobalId>;

Array<GlobalId, HostMemory> array_of(const Ids& ids) {
  const Array<GlobalId, HostMemory> array("test", ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) array(i) = ids[i];
  return array;
}

Ids vector_of(const Array<const GlobalId, HostMemory>& ids) { return {ids.data(), ids.data() + ids.extent(0)}; }

}  // namespace

TEST(ProcessAlone, has_what_it_says_to_others) {
  const Ranks& alone = Ranks::alone();
  EXPECT_TRUE(alone.is_alone());
  EXPECT_EQ(alone.rank(), 0);
  EXPECT_EQ(alone.size(), 1);
  EXPECT_EQ(alone.sum(7), 7);
  EXPECT_EQ(alone.least(std::int64_t(-3)), -3);
  EXPECT_EQ(alone.least(0.5), 0.5);
  EXPECT_EQ(alone.all(4), Ids{4});
  EXPECT_EQ(alone.sum_before(4), 0);
  EXPECT_EQ(alone.broadcast("what", 0), "what");
  EXPECT_EQ(alone.exchange_counts({5}), Ids{5});
  const auto received = detail::exchange(alone, "test", detail::EntriesByRank<GlobalId>{array_of({3, 1, 2}), {0, 3}});
  EXPECT_EQ(vector_of(received.entries), (Ids{3, 1, 2}));
  EXPECT_EQ(alone.sent().messages, 0);
}

TEST(ProcessAlone, throws_what_an_action_throws) {
  struct Special {};
  EXPECT_THROW(detail::together(Ranks::alone(), [] { throw Special(); }), Special);
}

TEST(ProcessAlone, has_the_places_and_sums_of_its_own) {
  const Array<detail::SimplexKey, HostMemory> keys("keys", 3);
  keys(0) = {9, 0, 0};
  keys(1) = {2, 5, 1};
  keys(2) = {2, 3, 7};
  const auto found = detail::places_of_keys(Ranks::alone(), keys);
  EXPECT_EQ(found.count, 3);
  EXPECT_EQ(vector_of(found.places), (Ids{2, 1, 0}));
  const Ids ids{30, 10, 20}, counts{1, 2, 4};
  const auto sums = detail::sums_before(Ranks::alone(), view_of(ids), view_of(counts));
  EXPECT_EQ(vector_of(sums.places), (Ids{6, 0, 2}));
  EXPECT_EQ(sums.count, 7);
  const Ids all{5, 8, 5}, asked{8, 5, 1};
  EXPECT_EQ(vector_of(detail::occurrences(Ranks::alone(), view_of(all), view_of(asked))), (Ids{1, 2, 0}));
}

TEST(ExchangeOfWholeMesh, knows_input_ids_alone) {
  const Mesh mesh = encode(mesh_named("two_sharing_a_triangle"), 100);
  const Exchange& exchange = mesh.exchange();
  EXPECT_FALSE(mesh.is_part());
  EXPECT_FALSE(exchange.is_of_part());
  EXPECT_TRUE(exchange.ranks().is_alone());
  EXPECT_EQ(mesh.all_vertices(), 5);
  EXPECT_EQ(mesh.all_cells(), 2);
  for (Id v = 0; v < 5; ++v) {
    EXPECT_EQ(mesh.vertex_id(v), v);
    EXPECT_EQ(mesh.vertex_of(v), v);
    EXPECT_EQ(exchange.owner(v), 0);
  }
  EXPECT_EQ(mesh.vertex_of(5), no_id);
  EXPECT_EQ(mesh.vertex_of(-1), no_id);
  EXPECT_EQ(mesh.cell_id(1), 1);
  EXPECT_EQ(exchange.owners_of(array_of({4, 2}))(1), 0);
  EXPECT_TRUE(exchange.from_owners().keeps_all());
}

}  // namespace gale::test
