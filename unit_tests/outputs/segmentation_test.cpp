#include <gtest/gtest.h>

#include <gale/outputs/segmentation.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

using namespace outputs;

TEST(Segments, of_a_mesh_are_an_array_in_input_order) {
  const Mesh mesh = encode(two_tetrahedra(), segmentation_by({7, -2, 7, 7, -2}));  // numbered by ascending label
  const io::PointArray array = segments_of(mesh);
  EXPECT_EQ(array.name, "ttkCompactTriangulationIndex");
  EXPECT_EQ(array.components, 1);
  EXPECT_EQ(values_of<std::int32_t>({array}, array.name), (std::vector<std::int32_t>{1, 0, 1, 1, 0}));
  EXPECT_EQ(labels_of(array), (std::vector<std::int64_t>{1, 0, 1, 1, 0}));
}

TEST(Segments, are_found_under_two_names_if_they_are_whole_numbers_one_a_point) {
  const io::PointArray ours{segments_name, 1, std::vector<std::int8_t>{0, 1}};
  const io::PointArray ttks{ttk_segments_name, 1, std::vector<std::uint64_t>{0, 1}};
  const io::PointArray reals{segments_name, 1, std::vector<float>{0, 1}};
  const io::PointArray pairs{ttk_segments_name, 2, std::vector<int>{0, 1, 2, 3}};
  const auto found = [](std::vector<io::PointArray> arrays, std::vector<std::string> expected_ignored) {
    io::Dataset dataset;
    dataset.arrays = std::move(arrays);
    std::vector<std::string> ignored;
    const io::PointArray* const array = find_segments(dataset, ignored);
    EXPECT_EQ(ignored, expected_ignored);
    return array != nullptr ? array->name : "none";
  };
  EXPECT_EQ(found({}, {}), "none");
  EXPECT_EQ(found({ttks, ours}, {}), segments_name) << "ours first";
  EXPECT_EQ(found({ttks, reals}, {segments_name}), ttk_segments_name);
  EXPECT_EQ(found({pairs, reals}, {segments_name, ttk_segments_name}), "none");
}

TEST(Segments, of_a_name_must_be_there_and_be_whole_numbers) {
  io::Dataset dataset;
  dataset.arrays = {{"parts", 1, std::vector<std::uint8_t>{255, 3}},
                    {"reals", 1, std::vector<double>{0, 1}},
                    {"pairs", 2, std::vector<int>{0, 1, 2, 3}}};
  EXPECT_EQ(labels_of(select_segments(dataset, "parts")), (std::vector<std::int64_t>{255, 3}));
  EXPECT_EQ(message_of([&] { select_segments(dataset, "part"); }),
            "no point array 'part' with segments: the input has parts, reals, pairs");
  EXPECT_EQ(message_of([&] { labels_of(select_segments(dataset, "reals")); }),
            "array 'reals' is of floating-point numbers: segments are whole numbers");
  EXPECT_EQ(message_of([&] { labels_of(select_segments(dataset, "pairs")); }),
            "array 'pairs' has 2 components: segments are one label a point");
}

}  // namespace gale::test
