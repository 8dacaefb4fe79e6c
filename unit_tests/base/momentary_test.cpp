#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/momentary.hpp>

namespace gale::test {

namespace {

struct Square {
  KOKKOS_FUNCTION Offset operator()(Id i) const { return Offset(i) * i; }
};

}  // namespace

TEST(Momentary, keeps_pieces_that_go_back_to_others) {
  constexpr std::size_t piece = std::size_t(2) << 20;
  EXPECT_EQ(detail::take_kept_bytes(0), nullptr);
  EXPECT_EQ(detail::take_kept_bytes(piece + 1), nullptr) << "more than a piece has";
  std::vector<std::shared_ptr<void>> taken;
  for (std::shared_ptr<void> one = detail::take_kept_bytes(piece); one; one = detail::take_kept_bytes(1)) {
    for (const auto& other : taken) EXPECT_NE(one, other);
    taken.push_back(one);
    ASSERT_LE(taken.size(), 8U);
  }
  ASSERT_GE(taken.size(), 1U);
  const void* const last = taken.back().get();
  taken.pop_back();
  EXPECT_EQ(detail::take_kept_bytes(100).get(), last);
  taken.clear();
}

TEST(Momentary, copies_what_the_host_has_also_where_no_piece_is_large_enough) {
  for (const Offset count : {0, 1, 1000, 1 << 20}) {
    const auto entries = detail::tabulated<Id>("entries", count, [](Offset i) { return static_cast<Id>(3 * i); });
    const detail::Momentary<const Id, WorkerMemory> there("copy", entries);
    const std::vector<Id> back = vector_of(there.array());
    EXPECT_EQ(back, std::vector<Id>(entries.data(), entries.data() + count));
  }
}

TEST(Momentary, lets_a_space_tell_values_at_places) {
  const std::vector<Id> places{5, 0, 7, 7, 40000};
  const std::vector<Offset> squares{25, 0, 49, 49, 1600000000};
  EXPECT_EQ(detail::results_at("square", WorkerSpace(), places, Square()), squares);
  EXPECT_EQ(detail::results_at("square", HostExecutionSpace(), places, Square()), squares);
  EXPECT_TRUE(detail::results_at("square", WorkerSpace(), std::vector<Id>(), Square()).empty());
}

}  // namespace gale::test
