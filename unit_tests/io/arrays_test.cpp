#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <gale/io/dataset.hpp>
#include <gale/io/write.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;

const PointArray pairs{"pairs", 2, std::vector<std::int16_t>{0, 1, 10, 11, 20, 21}};

TEST(Arrays, PointCountIsValuesByComponents) {
  EXPECT_EQ(point_count(pairs), 3u);
  EXPECT_EQ(point_count({"none", 1, std::vector<double>{}}), 0u);
}

TEST(Arrays, GatherTakesRowsInTheOrderOfTheIds) {
  const PointArray some = gather(pairs, std::vector<int>{2, 0, 2});
  EXPECT_EQ(some.name, "pairs");
  EXPECT_EQ(some.components, 2);
  EXPECT_EQ(test::values_of<std::int16_t>(some), (std::vector<std::int16_t>{20, 21, 0, 1, 20, 21}));
  EXPECT_EQ(point_count(gather(pairs, std::vector<int>{})), 0u);
}

TEST(Arrays, GatherTakesIdsFromAView) {
  const Kokkos::View<int*, Kokkos::HostSpace> ids("GALE::ids", 2);
  ids(1) = 1;
  EXPECT_EQ(test::values_of<std::int16_t>(gather(pairs, ids)), (std::vector<std::int16_t>{0, 1, 10, 11}));
}

TEST(Arrays, GatherKeepsEveryType) {
  const std::vector<PointArray> arrays = test::arrays_of_every_type(4);
  std::vector<PointArray> copies;
  for (const PointArray& array : arrays) copies.push_back(gather(array, std::vector<int>{0, 1, 2, 3}));
  test::expect_same(arrays, copies);
}

TEST(Arrays, GatherRefusesOtherIds) {
  EXPECT_EQ(error_of([] { gather(pairs, std::vector<int>{3}); }), "the array 'pairs' has 3 rows, no row 3");
  EXPECT_EQ(error_of([] { gather(pairs, std::vector<int>{-1}); }), "the array 'pairs' has 3 rows, no row -1");
}

TEST(Arrays, ExtractComponentIsNamedByItsNumber) {
  const PointArray second = extract_component(pairs, 1);
  EXPECT_EQ(second.name, "pairs_1");
  EXPECT_EQ(second.components, 1);
  EXPECT_EQ(test::values_of<std::int16_t>(second), (std::vector<std::int16_t>{1, 11, 21}));
  EXPECT_EQ(error_of([] { extract_component(pairs, 2); }), "the array 'pairs' has 2 components, no 2");
  EXPECT_EQ(error_of([] { extract_component(pairs, -1); }), "the array 'pairs' has 2 components, no -1");
}

TEST(Arrays, ToCsvWritesWhatIsReadBack) {
  EXPECT_EQ(to_csv({{"id", 1, std::vector<std::int64_t>{9007199254740993, -1}},
                    {"a,\"b\"", 2, std::vector<float>{0.5f, 1e30f, -2, std::nanf("")}},
                    {"value", 1, std::vector<double>{0.1, 1e-300}}}),
            "id,\"a,\"\"b\"\"_0\",\"a,\"\"b\"\"_1\",value\n9007199254740993,0.5,1.0000000150474662e+30,"
            "0.10000000000000001\n-1,-2,nan,1e-300\n");
  EXPECT_EQ(to_csv({{"", 1, std::vector<std::int8_t>{65, -1}}, {"b", 1, std::vector<std::uint8_t>{255, 0}}}),
            ",b\n65,255\n-1,0\n");
  EXPECT_EQ(to_csv({{"a", 1, std::vector<float>{}}}), "a\n");
  EXPECT_EQ(to_csv({}), "\n");
  EXPECT_EQ(error_of([] {
              to_csv({{"a", 1, std::vector<int>{1, 2}}, {"b", 1, std::vector<int>{1}}});
            }),
            "the column 'b' has 1 rows, 'a' 2");
}

}  // namespace
}  // namespace gale::io
