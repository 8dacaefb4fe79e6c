#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/simplify_field.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "distributed/given_parts.hpp"
#include "support/message_of.hpp"

// What analyses refuse on one rank, or are asked to stop, ends on all ranks.

namespace gale::test {

namespace {

/// A mesh on all ranks, of parts in one of the ways of part_of().
struct MeshOnRanks {
  explicit MeshOnRanks(const std::string& way) : part(part_of(input, way, ranks)), mesh(distribute(ranks, part, way)) {}

  bool is_last() const { return ranks.rank() + 1 == ranks.size(); }

  const Communicator ranks{MPI_COMM_WORLD};
  const InputMesh& input = mesh_named("holed_grid_9");
  const GivenPart part;
  const DistributedMesh mesh;
};

}  // namespace

TEST(WrongOptions, of_one_rank_end_all_alike) {
  const MeshOnRanks given("random");
  const VertexOrder order(given.mesh, given.part.values(std::vector<float>(given.input.vertices(), 1.0f)));
  const DiscreteGradient gradient = find_discrete_gradient(order);
  const std::string last = given.ranks.size() == 1 ? "" : "rank " + std::to_string(given.ranks.size() - 1) + ": ";
  const auto one = [](Id) { return 1.0; };
  MergeTreeOptions tree;
  tree.threshold = 1;
  if (!given.is_last()) tree.value = one;
  EXPECT_EQ(message_of([&] { find_merge_tree(order, Tree::join, tree); }),
            last + "a tree simplified by persistence needs the field's values");
  tree.value = one;
  tree.threshold = given.is_last() ? -1 : 1;
  EXPECT_EQ(message_of([&] { find_merge_tree(order, Tree::join, tree); }),
            last + "the persistence -1 is not 0 or more");
  EXPECT_EQ(message_of([&] { simplify_field(order, one, given.is_last() ? -1 : 1); }),
            last + "the persistence -1 is not 0 or more");
  ComputeOptions many;
  many.threads = given.is_last() ? 0 : 1;
  EXPECT_EQ(message_of([&] { find_critical_points(order, many); }), last + "threads is 0, not 1 to 1024");
  EXPECT_EQ(message_of([&] { find_morse_smale_complex(gradient, {}, many); }), last + "threads is 0, not 1 to 1024");
  EXPECT_EQ(message_of([&] { gather_persistence_pairs(gradient, many); }), last + "threads is 0, not 1 to 1024");
  if (have_device) return;
  ComputeOptions place;
  if (given.is_last()) place.consumers = ConsumerPlace::device;
  EXPECT_EQ(message_of([&] { find_discrete_gradient(order, place); }), last + "this gale has no device for consumers");
}

TEST(Stopping, ends_the_rank_that_is_asked_as_a_process_alone_and_fails_on_others) {
  const MeshOnRanks given("random");
  const VertexOrder order(given.mesh, given.part.values(std::vector<float>(given.input.vertices(), 1.0f)));
  StopRequest request;
  if (given.is_last()) request.stop();
  const StopScope stoppable(&request);
  std::string end = "none";
  try {
    find_discrete_gradient(order);
  } catch (const Stopped&) {
    end = "stopped";
  } catch (const SharedError& error) {
    end = error.what();
  }
  EXPECT_EQ(end, given.is_last()
                     ? "stopped"
                     : "rank " + std::to_string(given.ranks.size() - 1) + ": the computation was asked to stop");
}

TEST(Stopping, leaves_no_rank_waiting_whenever_it_comes) {
  const MeshOnRanks given("random");
  const VertexOrder order(given.mesh, given.part.values(random_field(given.input, 3)));
  const auto value = [&](Id v) { return std::sin(static_cast<double>(given.mesh.vertex_id(v))); };
  for (int i = 0; i < 100; ++i) {
    StopRequest request;
    std::thread asks([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * i));
      if (given.is_last()) request.stop();
    });
    std::int64_t ended = 0;
    try {
      const StopScope stoppable(&request);
      simplify_field(order, value, 0.1);
      ended = 1;
    } catch (const Stopped&) {
      EXPECT_TRUE(given.is_last());
    } catch (const SharedError& error) {
      EXPECT_FALSE(given.is_last()) << error.what();
    }
    asks.join();
    EXPECT_EQ(given.ranks.sum(ended) % given.ranks.size(), 0) << "some ranks alone have ended";
  }
}

TEST(PartsOfMeshes, are_refused_by_what_needs_the_whole) {
  const MeshOnRanks given("random");
  if (given.ranks.size() == 1) return;
  const std::string which =
      " can't be found of one rank's part of a mesh: it lies on " + std::to_string(given.ranks.size()) + " ranks";
  const VertexOrder order(given.mesh, given.part.values(std::vector<float>(given.input.vertices(), 1.0f)));
  const DiscreteGradient gradient = find_discrete_gradient(order);
  EXPECT_EQ(message_of([&] { find_persistence_pairs(gradient); }),
            "persistence pairs" + which + ", which gather_gradient() brings together");
}

TEST(PartsOfMeshes, say_what_is_wrong_with_fields_to_simplify) {
  const MeshOnRanks given("random");
  std::vector<float> heights(given.input.vertices());
  std::iota(heights.begin(), heights.end(), 0.0f);
  const VertexOrder order(given.mesh, given.part.values(heights));
  if (given.ranks.size() == 1) return;
  const auto nan = [](Id) { return std::nan(""); };
  EXPECT_NE(message_of([&] { simplify_field(order, nan, 1); }).find("has no field value"), std::string::npos);
  StayingExtrema outside, regular;
  if (given.ranks.rank() == 1) outside.minima = {given.mesh.vertices()};
  EXPECT_NE(message_of([&] { simplify_field(order, outside); }).find("rank 1: vertex"), std::string::npos);
  // The highest is no minimum; its global id is said.
  const GlobalId top = vertex_name(given.input.vertices() - 1);
  const Id here = given.mesh.vertex_of(top);
  if (here != no_id) regular.minima = {here};
  EXPECT_EQ(message_of([&] { simplify_field(order, regular); }),
            "rank 0: vertex " + std::to_string(top) + ", which is to stay, is no minimum of the field");
}

TEST(DistributedAlgorithms, fail_on_all_ranks_where_one_lacks_what_it_reads) {
  const MeshOnRanks given("blocks");
  const VertexOrder order(given.mesh, given.part.values(std::vector<int>(given.input.vertices(), 1)));
  const auto structure =
      make_structure(given.mesh, given.is_last() ? RelationSet(Relation::VV) : discrete_gradient_relations);
  EXPECT_NE(message_of([&] { find_discrete_gradient(*structure, order); }), "no error");
}

}  // namespace gale::test
