#include <gtest/gtest.h>

#include <gale/base/error.hpp>

namespace gale::test {

TEST(RequireIds, accepts_as_many_as_an_id_counts) { EXPECT_NO_THROW(require_ids("edges", 2147483647)); }

TEST(RequireIds, refuses_one_more_by_name_and_number) {
  try {
    require_ids("edges", Offset(2147483647) + 1);
    FAIL() << "accepts too many";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "2147483648 edges are too many: ids have 32 bits, at most 2147483647 fit");
  }
}

}  // namespace gale::test
