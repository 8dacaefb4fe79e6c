#include <limits>

#include <gtest/gtest.h>

#include <gale/io/image.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::names_of;
using test::values_of;

Image two_arrays() {
  Image image;
  image.dimensions = {2, 1, 1};
  image.arrays = {{"density", 1, std::vector<float>{1, 2}}, {"flow", 3, std::vector<float>{1, 2, 3, 4, 5, 6}}};
  return image;
}

TEST(SelectScalars, PutsTheArrayFirst) {
  Image image = two_arrays();
  image.arrays.push_back({"heat", 1, std::vector<float>{3, 4}});
  select_scalars(image, "heat");
  EXPECT_EQ(names_of(image.arrays), (std::vector<std::string>{"heat", "density", "flow"}));
  select_scalars(image, "");
  EXPECT_EQ(names_of(image.arrays), (std::vector<std::string>{"heat", "density", "flow"}));
}

TEST(SelectScalars, PicksAComponent) {
  Image image = two_arrays();
  select_scalars(image, "flow_2");
  EXPECT_EQ(names_of(image.arrays), (std::vector<std::string>{"flow_2", "density", "flow"}));
  EXPECT_EQ(values_of<float>(image.arrays[0]), (std::vector<float>{3, 6}));
}

TEST(SelectScalars, RefusesWhatIsNotThereOrNotOneNumber) {
  Image image = two_arrays();
  EXPECT_EQ(error_of([&] { select_scalars(image, "heat"); }), "the image has no array 'heat', only 'density', 'flow'");
  EXPECT_EQ(error_of([&] { select_scalars(image, "flow_3"); }),
            "the image has no array 'flow_3', only 'density', 'flow'");
  EXPECT_EQ(error_of([&] { select_scalars(image, "flow"); }),
            "the array 'flow' has 3 components: choose one of 'flow_0' to 'flow_2'");
  image.arrays.clear();
  EXPECT_EQ(error_of([&] { select_scalars(image, ""); }), "the image has no scalars");
}

TEST(Rescale, MakesFloatsOfSmallTypesAndDoublesOfLargeOnes) {
  Image image;
  image.arrays = {{"short", 1, std::vector<std::int16_t>{-1, 2}}, {"int", 1, std::vector<std::int32_t>{2147483647}}};
  rescale(image, 0.5, 10);
  EXPECT_EQ(values_of<float>(image.arrays[0]), (std::vector<float>{9.5f, 11}));
  EXPECT_EQ(values_of<double>(image.arrays[1]), (std::vector<double>{1073741833.5}));
}

TEST(Rescale, LeavesAloneWhatItWouldNotChange) {
  Image image;
  image.arrays = {{"short", 1, std::vector<std::int16_t>{-1, 2}}};
  rescale(image, 1, 0);
  rescale(image, 0, 5);
  rescale(image, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_EQ(values_of<std::int16_t>(image.arrays[0]), (std::vector<std::int16_t>{-1, 2}));
}

}  // namespace
}  // namespace gale::io
