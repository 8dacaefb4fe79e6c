#include <limits>

#include <gtest/gtest.h>

#include <gale/outputs/persistence.hpp>

#include "support/message_of.hpp"

namespace gale::test {

using outputs::threshold_of;

TEST(Persistence, a_difference_of_values_is_the_threshold_itself) {
  const io::PointArray field{"field", 1, std::vector<double>{2, 12, -std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(threshold_of({0.5, false}, field), 0.5);
}

TEST(Persistence, percents_are_of_the_range) {
  EXPECT_EQ(threshold_of({20, true}, {"field", 1, std::vector<double>{2, 12, 7}}), 2);
  EXPECT_EQ(threshold_of({50, true}, {"field", 1, std::vector<std::uint8_t>{200, 100, 255}}), 77.5);
  EXPECT_EQ(threshold_of({50, true}, {"field", 1, std::vector<std::int8_t>{-128, 127}}), 127.5);
  EXPECT_EQ(threshold_of({100, true}, {"field", 1, std::vector<float>{3, 3}}), 0) << "constant";
}

TEST(Persistence, nan_is_no_part_of_the_range) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(threshold_of({10, true}, {"field", 1, std::vector<double>{nan, 1, 11, nan}}), 1);
}

TEST(Persistence, there_are_no_percents_of_an_infinite_range) {
  const io::PointArray field{"height", 1, std::vector<double>{0, std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(message_of([&] {
              threshold_of({10, true}, field);
            }),
            "there are no percents of the range of 'height', which isn't finite");
}

}  // namespace gale::test
