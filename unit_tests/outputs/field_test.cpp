#include <gtest/gtest.h>

#include <gale/outputs/field.hpp>
#include <gale/outputs/segmentation.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

using namespace outputs;

namespace {

io::Dataset with(std::vector<io::PointArray> arrays) {
  io::Dataset dataset;
  dataset.arrays = std::move(arrays);
  return dataset;
}

const io::PointArray segments{segments_name, 1, std::vector<int>{0, 0}};
const io::PointArray order{"height_Order", 1, std::vector<int>{1, 0}};
const io::PointArray velocity{"velocity", 3, std::vector<float>{1, 2, 3, 4, 5, 6}};
const io::PointArray height{"height", 1, std::vector<float>{0.5f, 0.25f}};
const io::PointArray other{"other", 1, std::vector<double>{1, 2}};

/// The vertices of the unit tetrahedron in the order that the arrays say, lowest first.
std::vector<Id> ascending(const std::vector<io::PointArray>& arrays) {
  const InputMesh input = unit_tetrahedron();
  const Mesh mesh = encode(input, 2);
  const VertexOrder order = order_of(mesh, with(arrays), arrays.front());
  std::vector<Id> vertices{0, 1, 2, 3};
  const auto key = [&](Id v) { return order.keys()[mesh.vertex_internal()(v)]; };
  std::sort(vertices.begin(), vertices.end(), [&](Id a, Id b) { return key(a) < key(b); });
  return vertices;
}

}  // namespace

TEST(SelectField, without_a_name_takes_the_first_that_is_neither_segments_nor_an_order) {
  EXPECT_EQ(select_field(with({segments, order, velocity, height, other}), "").name, "height");
  EXPECT_EQ(message_of([] {
              select_field(with({segments, order, velocity}), "");
            }),
            "no point array to analyse: the input has ttkCompactTriangulationIndex, height_Order, velocity");
  EXPECT_EQ(message_of([] { select_field(with({}), ""); }), "no point array to analyse: the input has no point arrays");
}

TEST(AddHeight, puts_a_coordinate_first_in_the_points_type) {
  const auto check = [](auto example) {
    using Coordinate = decltype(example);
    io::Dataset dataset = with({height, {height_name, 1, std::vector<int>{7, 7}}});
    const io::Dataset::Points<Coordinate> points("points", 2);
    for (int i = 0; i < 2; ++i) {
      for (int axis = 0; axis < 3; ++axis) points(i, axis) = static_cast<Coordinate>(10 * i + axis);
    }
    dataset.points = points;
    add_height(dataset, 2);
    ASSERT_EQ(dataset.arrays.size(), 2u) << "the one of that name goes";
    EXPECT_EQ(std::get<std::vector<Coordinate>>(dataset.arrays[0].values), (std::vector<Coordinate>{2, 12}));
    EXPECT_EQ(select_field(dataset, "").name, "Height");
    EXPECT_EQ(dataset.arrays[1].name, "height");
  };
  check(float());
  check(double());
}

TEST(SelectField, without_a_name_takes_what_is_called_as_segments_but_holds_none) {
  EXPECT_EQ(select_field(with({{ttk_segments_name, 1, std::vector<float>{0.5f, 1}}, height}), "").name, "_index");
}

TEST(SelectField, by_name) {
  const io::Dataset dataset = with({segments, order, velocity, height, other});
  EXPECT_EQ(values_of<double>({select_field(dataset, "other")}, "other"), (std::vector<double>{1, 2}));
  EXPECT_EQ(select_field(dataset, "height_Order").name, "height_Order");
  EXPECT_EQ(select_field(dataset, segments_name).name, segments_name);
  EXPECT_EQ(message_of([&] {
              select_field(with({height, other}), "missing");
            }),
            "no point array 'missing': the input has height, other");
}

TEST(SelectField, takes_a_component_by_its_number) {
  const io::Dataset dataset = with({velocity, height});
  const io::PointArray second = select_field(dataset, "velocity_1");
  EXPECT_EQ(second.components, 1);
  EXPECT_EQ(values_of<float>({second}, "velocity_1"), (std::vector<float>{2, 5}));
  EXPECT_EQ(values_of<float>({select_field(dataset, "height_0")}, "height_0"), (std::vector<float>{0.5f, 0.25f}));
  EXPECT_EQ(message_of([&] { select_field(dataset, "velocity"); }),
            "array 'velocity' has 3 components: name one, as velocity_0");
  for (const std::string name :
       {"velocity_3", "velocity_", "velocity_x", "velocity_-1", "velocity_99999999999", "_1"}) {
    EXPECT_EQ(message_of([&] { select_field(dataset, name); }),
              "no point array '" + name + "': the input has velocity, height");
  }
}

TEST(SelectField, prefers_an_array_of_that_very_name_to_a_component) {
  const io::Dataset dataset = with({velocity, {"velocity_1", 1, std::vector<int>{7, 8}}});
  EXPECT_EQ(values_of<int>({select_field(dataset, "velocity_1")}, "velocity_1"), (std::vector<int>{7, 8}));
}

TEST(ValueAt, is_the_value_of_any_type_as_a_double) {
  EXPECT_EQ(value_at(height, 1), 0.25);
  EXPECT_EQ(value_at({"bytes", 1, std::vector<std::uint8_t>{0, 255}}, 1), 255);
}

TEST(OrderOf, a_field_is_that_of_its_values_then_of_the_ids) {
  EXPECT_EQ(ascending({{"f", 1, std::vector<int>{3, 1, 3, -5}}}), (std::vector<Id>{3, 1, 0, 2}));
}

TEST(OrderOf, a_field_is_that_of_the_array_beside_it_if_there_is_one) {
  const io::PointArray f{"f", 1, std::vector<float>{0, 0, 0, 0}};
  EXPECT_EQ(ascending({f, {"f_Order", 1, std::vector<int>{2, 3, 0, 1}}}), (std::vector<Id>{2, 3, 0, 1}));
  EXPECT_EQ(ascending({f, {"f_Order", 1, std::vector<double>{2, 3, 0, 1}}}), (std::vector<Id>{2, 3, 0, 1}));
  EXPECT_EQ(ascending({f, {"g_Order", 1, std::vector<int>{2, 3, 0, 1}}}), (std::vector<Id>{0, 1, 2, 3}));
  EXPECT_EQ(ascending({f, {"f_Order", 2, std::vector<int>{2, 3, 0, 1, 7, 7, 7, 7}}}), (std::vector<Id>{0, 1, 2, 3}))
      << "of two components: no order";
}

TEST(OrderOf, an_order_may_contradict_the_values) {
  const io::PointArray f{"f", 1, std::vector<float>{0, 1, 1, 2}};
  const auto note_in = [&](const io::Dataset& dataset) {
    std::string note;
    order_values(dataset, f, 4, &note);
    return note;
  };
  const auto note = [&](std::vector<int> order) { return note_in(with({f, {"f_Order", 1, order}})); };
  EXPECT_EQ(note({0, 2, 1, 3}), "");
  EXPECT_EQ(note_in(with({f})), "");
  EXPECT_EQ(ascending({f, {"f_Order", 1, std::vector<int>{3, 0, 2, 1}}}), (std::vector<Id>{1, 3, 2, 0}));
  EXPECT_EQ(
      note({3, 0, 2, 1}),
      "'f_Order' orders the vertices, though it contradicts 'f': vertex 2 comes after vertex 3, which has a higher "
      "value");
}

TEST(IsRounded, a_field_of_whole_numbers_that_are_no_doubles) {
  const std::int64_t most = std::int64_t(1) << 53;
  EXPECT_FALSE(is_rounded({"f", 1, std::vector<std::int64_t>{most, -most}}));
  EXPECT_TRUE(is_rounded({"f", 1, std::vector<std::int64_t>{0, most + 1}}));
  EXPECT_TRUE(is_rounded({"f", 1, std::vector<std::int64_t>{0, -most - 1}}));
  EXPECT_TRUE(is_rounded({"f", 1, std::vector<std::uint64_t>{~std::uint64_t(0)}}));
  EXPECT_FALSE(is_rounded({"f", 1, std::vector<double>{1e300}}));
  EXPECT_FALSE(is_rounded({"f", 1, std::vector<int>{1}}));
}

TEST(OrderOf, an_order_must_be_a_permutation) {
  const io::PointArray f{"f", 1, std::vector<float>{0, 0, 0, 0}};
  const auto refused = [&](io::PointArray::Values values) {
    const std::string message = message_of([&] { ascending({f, {"f_Order", 1, values}}); });
    const std::string begin = "array 'f_Order' is no permutation of 0 to 3: vertex ";
    return message.substr(0, begin.size()) == begin ? message.substr(begin.size()) : message;
  };
  EXPECT_EQ(refused(std::vector<int>{0, 1, 1, 2}), "2 has 1");
  EXPECT_EQ(refused(std::vector<int>{0, 1, 2, 4}), "3 has 4");
  EXPECT_EQ(refused(std::vector<std::int64_t>{0, -1, 2, 3}), "1 has -1");
  EXPECT_EQ(refused(std::vector<float>{0, 1, 2.5, 3}), "2 has 2.500000");
  EXPECT_EQ(refused(std::vector<int>{0, 1, 2}), "array 'f_Order' has 3 values for 4 vertices");
}

TEST(AddHeight, knows_three_axes) {
  io::Dataset dataset = with({});
  EXPECT_EQ(message_of([&] { outputs::add_height(dataset, 3); }), "there is no axis 3: 0 is x, 2 is z");
  EXPECT_EQ(message_of([&] { outputs::add_height(dataset, -1); }), "there is no axis -1: 0 is x, 2 is z");
}

}  // namespace gale::test
