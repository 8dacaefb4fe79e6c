#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <gale/algorithms/vertex_order.hpp>

#include "distributed/given_parts.hpp"
#include "support/message_of.hpp"

namespace gale::test {

template <class Value>
class OrderOnRanksOf : public testing::Test {};

using ValueTypes = testing::Types<char, signed char, unsigned char, short, unsigned short, int, unsigned int, long,
                                  unsigned long, long long, unsigned long long, float, double>;
TYPED_TEST_SUITE(OrderOnRanksOf, ValueTypes);

/// Any values, also extreme ones, many of them equal.
template <class Value>
std::vector<Value> any_values(Id count) {
  using Limits = std::numeric_limits<Value>;
  std::mt19937 random(17);
  std::vector<Value> values(count);
  for (Value& value : values) {
    const auto any = random() % 40;
    value = any == 0 ? Limits::lowest() : any == 1 ? Limits::max() : static_cast<Value>(any);
  }
  return values;
}

TYPED_TEST(OrderOnRanksOf, compares_vertices_by_value_then_by_global_id) {
  const Communicator ranks(MPI_COMM_WORLD, 1000);
  const InputMesh& input = mesh_named("random_tetrahedra");
  const auto values = any_values<TypeParam>(input.vertices());
  for (const std::string& partition : partition_names()) {
    const GivenPart part = part_of(input, partition, ranks);
    const DistributedMesh mesh = distribute(ranks, part, partition);
    const VertexOrder order(mesh, part.values(values));
    const std::uint64_t* const keys = order.keys();
    const Mesh& local = mesh;
    const auto rank_of = [&](Id v) {
      const Id there = vertex_named(mesh.vertex_ids()(local.vertex_input()(v)));
      return std::make_pair(values[there], there);
    };
    for (Id v = 0; v < local.vertices(); ++v) {
      for (Id w = 0; w < local.vertices(); ++w) EXPECT_EQ(keys[v] < keys[w], rank_of(v) < rank_of(w));
    }
  }
}

TEST(OrderOnRanks, takes_the_value_of_the_lowest_rank_that_hands_a_vertex_over) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("random_tetrahedra");
  const GivenPart part = part_of(input, "shared", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "curve");
  std::vector<int> values(input.vertices());
  for (Id v = 0; v < input.vertices(); ++v) values[v] = ranks.rank() == 0 ? -v : v;
  const VertexOrder order(mesh, part.values(values));
  const Mesh& local = mesh;
  for (Id v = 1; v < local.vertices(); ++v) {
    const auto id = [&](Id vertex) { return mesh.vertex_ids()(local.vertex_input()(vertex)); };
    EXPECT_EQ(order.keys()[v]<order.keys()[0], id(v)> id(0));
  }
}

TEST(OrderOnRanks, names_the_least_vertex_without_a_value_on_all_ranks) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("random_tetrahedra");
  std::vector<double> values(input.vertices(), 1.0);
  values[59] = values[23] = values[40] = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& partition : partition_names()) {
    const GivenPart part = part_of(input, partition, ranks);
    const DistributedMesh mesh = distribute(ranks, part, partition);
    EXPECT_EQ(message_of([&] { VertexOrder(mesh, part.values(values)); }),
              "vertex " + std::to_string(vertex_name(23)) + " has no field value: it is NaN");
  }
}

TEST(OrderOnRanks, refuses_another_number_of_values_on_all_ranks) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("random_tetrahedra");
  const GivenPart part = part_of(input, "last", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "last");
  const Kokkos::View<int*, HostMemory> two("test", ranks.rank() + 1 == ranks.size() ? 2 : 0);
  const std::string prefix = ranks.size() == 1 ? "" : "rank " + std::to_string(ranks.size() - 1) + ": ";
  EXPECT_EQ(message_of([&] { VertexOrder(mesh, two); }),
            prefix + "the field has 2 values, this part of the mesh 60 vertices");
}

}  // namespace gale::test
