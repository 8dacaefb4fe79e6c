#include <limits>

#include <gtest/gtest.h>

#include <gale/outputs/merge_tree.hpp>
#include <gale/outputs/simplified_field.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

/// A strip of tetrahedra along 0 1 2 3 4 5 6, on a line: valleys at its ends, and a pass at 1.
struct TwoValleys {
  InputMesh input;
  std::vector<double> values = {0, 4, 5, 6, 3, 2, 1};
  io::Dataset dataset;
  io::PointArray field;
  VertexOrder order;

  TwoValleys() : input(strip()), dataset(dataset_of(input)), field{"height", 1, values}, order(order_of()) {
    dataset.arrays = {field};
  }

  static InputMesh strip() {
    InputMesh mesh;
    for (Id i = 0; i < 7; ++i) mesh.points.push_back({double(i), 0, 0});
    for (Id i = 0; i + 3 < 7; ++i) mesh.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
    return mesh;
  }
  VertexOrder order_of() const { return VertexOrder(encode(input, 100), values.data(), values.size()); }
};

}  // namespace

TEST(TreeNodes, have_their_vertices_values_and_arcs) {
  const TwoValleys of;
  const io::PointSet nodes = outputs::tree_nodes(of.dataset, of.field, find_merge_tree(of.order, Tree::join));
  expect_points(nodes.points, {{0, 0, 0}, {6, 0, 0}, {1, 0, 0}, {3, 0, 0}});
  EXPECT_EQ(names_of(nodes.arrays), (std::vector<std::string>{"height", "NodeId", "Scalar", "VertexId", "CriticalType",
                                                              "RegionSize", "RegionSpan"}));
  EXPECT_EQ(values_of<double>(nodes.arrays, "Scalar"), (std::vector<double>{0, 1, 4, 6}));
  EXPECT_EQ(values_of<Id>(nodes.arrays, "VertexId"), (std::vector<Id>{0, 6, 1, 3}));
  EXPECT_EQ(values_of<std::int8_t>(nodes.arrays, "CriticalType"), (std::vector<std::int8_t>{0, 0, 1, 3}));
  EXPECT_EQ(values_of<Id>(nodes.arrays, "RegionSize"), (std::vector<Id>{0, 2, 1, 1}));
  EXPECT_EQ(values_of<double>(nodes.arrays, "RegionSpan"), (std::vector<double>{1, 5, 2, 2}));
}

TEST(TreeArcs, go_over_barycentres_of_parts_that_are_equally_high) {
  const TwoValleys of;
  const MergeTree tree = find_merge_tree(of.order, Tree::join);
  const io::Surface straight = outputs::tree_arcs(of.dataset, of.field, tree);
  EXPECT_EQ(straight.lines.points, (std::vector<std::int32_t>{0, 2, 1, 2, 2, 3}));
  EXPECT_EQ(straight.lines.begin, (std::vector<std::int64_t>{0, 2, 4, 6}));
  const io::Surface sampled = outputs::tree_arcs(of.dataset, of.field, tree, 1);
  // From vertex 6 to vertex 1 over the middle of 5 and 4; from there to 3 over 2.
  expect_points(sampled.points, {{0, 0, 0}, {6, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4.5, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(sampled.lines.points, (std::vector<std::int32_t>{0, 2, 1, 4, 2, 2, 5, 3}));
  EXPECT_EQ(values_of<double>(sampled.point_arrays, "Scalar"), (std::vector<double>{0, 1, 4, 6, 2.5, 5}));
  EXPECT_EQ(values_of<std::int8_t>(sampled.point_arrays, "RegularMask"), (std::vector<std::int8_t>{0, 0, 0, 0, 1, 1}));
  const io::Surface finer = outputs::tree_arcs(of.dataset, of.field, tree, 3);
  EXPECT_EQ(finer.lines.points, (std::vector<std::int32_t>{0, 2, 1, 4, 5, 2, 2, 6, 3})) << "empty parts have no point";
  const io::Surface finest = outputs::tree_arcs(of.dataset, of.field, tree, std::numeric_limits<int>::max());
  EXPECT_EQ(finest.lines.points, finer.lines.points) << "which takes no memory for what is empty";
  EXPECT_EQ(values_of<Id>(sampled.cell_arrays, "upNodeId"), (std::vector<Id>{2, 2, 3}));
  EXPECT_EQ(values_of<Id>(sampled.cell_arrays, "downNodeId"), (std::vector<Id>{0, 1, 2}));
  EXPECT_EQ(values_of<Id>(sampled.cell_arrays, "RegionSize"), (std::vector<Id>{0, 2, 1}));
}

TEST(TreeSegmentation, says_what_each_vertex_belongs_to) {
  const TwoValleys of;
  const auto arrays = outputs::tree_segmentation(of.dataset, find_merge_tree(of.order, Tree::join));
  EXPECT_EQ(values_of<Id>(arrays, "SegmentationId"), (std::vector<Id>{0, 2, 2, 2, 1, 1, 1}));
  EXPECT_EQ(values_of<std::int8_t>(arrays, "RegionType"), (std::vector<std::int8_t>{0, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(values_of<Id>(arrays, "RegionSize"), (std::vector<Id>{0, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(values_of<double>(arrays, "RegionSpan"), (std::vector<double>{1, 2, 2, 2, 5, 5, 5}));
}

TEST(TreeNames, are_known) {
  EXPECT_EQ(outputs::tree_named("split"), Tree::split);
  EXPECT_EQ(message_of([] { outputs::tree_named("oak"); }), "there is no tree 'oak'");
}

TEST(SimplifiedArrays, are_the_field_and_its_order) {
  const TwoValleys of;
  const auto arrays =
      outputs::simplified_arrays(of.field, simplify_field(
                                               of.order, [&](Id vertex) { return of.values[vertex]; }, 3.5));
  EXPECT_EQ(names_of(arrays), (std::vector<std::string>{"height", "height_Order"}));
  EXPECT_EQ(values_of<double>(arrays, "height"), (std::vector<double>{0, 4, 5, 6, 4, 4, 4}));
  EXPECT_EQ(values_of<Id>(arrays, "height_Order"), (std::vector<Id>{0, 1, 5, 6, 2, 4, 3}));
}

}  // namespace gale::test
