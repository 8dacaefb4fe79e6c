#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/error.hpp>

#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

const InputMesh& input() { return mesh_named("random_tetrahedra"); }

Mesh mesh_of_input() { return encode(input(), octree_of(input(), 7)); }

/// Do keys compare as (value, input id) do, for each pair of vertices?
template <class Value>
void expect_order(const Mesh& mesh, const std::vector<Value>& values) {
  const VertexOrder order(mesh, values.data(), values.size());
  const auto& inputs = mesh.vertex_input();
  for (Id a = 0; a < mesh.vertices(); ++a) {
    for (Id b = 0; b < mesh.vertices(); ++b) {
      const bool below = std::make_pair(values[inputs(a)], inputs(a)) < std::make_pair(values[inputs(b)], inputs(b));
      ASSERT_EQ(order.keys()[a] < order.keys()[b], below) << +values[inputs(a)] << " and " << +values[inputs(b)];
    }
  }
}

template <class Value>
std::vector<Value> values_of() {
  std::mt19937_64 random(7);
  std::vector<Value> values;
  for (Id v = 0; v < input().vertices(); ++v) {
    if (v % 3 == 0) {
      values.push_back(static_cast<Value>(v / 9 % 5));
    } else {
      values.push_back(v % 3 == 1 ? static_cast<Value>(random()) : std::numeric_limits<Value>::lowest());
    }
  }
  return values;
}

}  // namespace

template <class Value>
class VertexOrderOf : public testing::Test {};
using ValueTypes =
    testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, std::int64_t,
                   std::uint64_t, float, double, char, long, unsigned long, long long, unsigned long long>;
TYPED_TEST_SUITE(VertexOrderOf, ValueTypes);

TYPED_TEST(VertexOrderOf, each_type_is_by_value_then_by_input_id) {
  expect_order(mesh_of_input(), values_of<TypeParam>());
}

template <class Value>
class FloatingVertexOrder : public testing::Test {};
using FloatingValues = testing::Types<float, double>;
TYPED_TEST_SUITE(FloatingVertexOrder, FloatingValues);

TYPED_TEST(FloatingVertexOrder, has_infinities_subnormals_and_equal_zeros) {
  using Limits = std::numeric_limits<TypeParam>;
  const TypeParam some[] = {Limits::infinity(),   TypeParam(0),          -Limits::infinity(), -TypeParam(0),
                            Limits::denorm_min(), -Limits::denorm_min(), Limits::max(),       Limits::lowest()};
  std::vector<TypeParam> values;
  for (Id v = 0; v < input().vertices(); ++v) values.push_back(some[v * 5 % 8]);
  expect_order(mesh_of_input(), values);
}

TYPED_TEST(FloatingVertexOrder, refuses_nan_and_names_the_first_vertex) {
  std::vector<TypeParam> values(input().points.size(), TypeParam(1));
  values[5] = values[9] = std::numeric_limits<TypeParam>::quiet_NaN();
  const Mesh mesh = mesh_of_input();
  try {
    const VertexOrder order(mesh, values.data(), values.size());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "vertex 5 has no field value: it is NaN");
  }
}

TEST(VertexOrder, finds_the_highest_of_some) {
  const InputMesh grid = holed_grid(24);  // enough for several threads
  const Mesh mesh = encode(grid, octree_of(grid, 64));
  std::mt19937 random(5);
  std::vector<float> values(mesh.vertices());
  for (float& value : values) value = static_cast<float>(random() % 1000);
  const VertexOrder order(mesh, values.data(), values.size());
  const Id count = mesh.vertices();
  for (const Interval some : {Interval{0, count}, {count / 3, count}, {7, 8}, {100, 9000}, {0, 4097}}) {
    const Id found = order.highest(some);
    ASSERT_TRUE(some.has(found));
    for (Id v = some.first; v < some.last; ++v) ASSERT_GE(order.keys()[found], order.keys()[v]);
  }
  EXPECT_EQ(order.highest({5, 5}), no_id);
}

TEST(VertexOrder, tells_the_keys_of_some) {
  const Mesh mesh{Grid(std::array<Id, 3>{4, 3, 3})};
  std::vector<float> field(mesh.vertices());
  for (Id v = 0; v < mesh.vertices(); ++v) field[v] = static_cast<float>(v % 5) - 2;
  const VertexOrder order(mesh, field.data(), field.size());
  const std::vector<Id> some{7, 0, 35, 7};
  const auto keys = order.keys_of(some), values = order.value_keys_of(some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(keys[i], order.keys()[some[i]]);
    EXPECT_EQ(values[i], order.value_key(some[i]));
  }
  EXPECT_TRUE(order.keys_of({}).empty());
  EXPECT_TRUE(order.value_keys_of({}).empty());
}

TEST(VertexOrder, refuses_another_number_of_values) {
  const std::vector<float> values(3);
  const Mesh mesh = mesh_of_input();
  try {
    const VertexOrder order(mesh, values.data(), values.size());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), "the field has 3 values, the mesh " + std::to_string(mesh.vertices()) + " vertices");
  }
}

TEST(VertexOrder, takes_a_place_of_each_vertex) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 20);
  EXPECT_EQ(message_of([&] {
              VertexOrder::of_places(mesh, {2, 0, 1});
            }),
            "there are 3 places, the mesh has 4 vertices");
}

}  // namespace gale::test
