#include <vector>

#include <gtest/gtest.h>

#include <gale/base/csr.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

template <class Rows>
std::vector<std::vector<Id>> lists_of_rows(const Rows& rows) {
  std::vector<std::vector<Id>> lists;
  for (Offset i = 0; i < rows.rows(); ++i) lists.emplace_back(rows.row(i).begin(), rows.row(i).end());
  return lists;
}

}  // namespace

TEST(Csr, has_no_rows_until_it_is_made) {
  const Csr<Id, HostMemory> nothing;
  EXPECT_EQ(nothing.rows(), 0);
}

TEST(Csr, is_read_row_by_row) {
  const std::vector<Offset> offsets = {0, 2, 2, 5};
  const std::vector<Id> entries = {7, 8, 1, 2, 3};
  const Csr<const Id, HostMemory> rows = {view_of(offsets), view_of(entries)};
  EXPECT_EQ(lists_of_rows(rows), (std::vector<std::vector<Id>>{{7, 8}, {}, {1, 2, 3}}));
  EXPECT_EQ(rows.row(2).size(), 3);
  EXPECT_EQ(rows.row(2)[1], 2);
}

TEST(Csr, becomes_one_that_nobody_writes) {
  const Csr<Id, HostMemory, Id> rows = {Array<Id, HostMemory>("offsets", 3), Array<Id, HostMemory>("entries", 2)};
  rows.offsets(1) = 1;
  rows.offsets(2) = 2;
  rows.row(1)[0] = 5;
  const Csr<const Id, HostMemory, Id> read = rows;
  EXPECT_EQ(lists_of_rows(read), (std::vector<std::vector<Id>>{{0}, {5}}));
  EXPECT_EQ(read.entries.data(), rows.entries.data());
}

}  // namespace gale::test
