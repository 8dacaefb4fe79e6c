#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <gale/base/bits.hpp>

namespace gale::test {

namespace {

/// Calls body(word) for words with no bit, one, all but one, and all of them, and for random ones with few to many.
template <class Body>
void for_words(const Body& body) {
  std::mt19937_64 random(7);
  body(std::uint64_t(0));
  body(~std::uint64_t(0));
  for (int bit = 0; bit < 64; ++bit) {
    body(std::uint64_t(1) << bit);
    body(~(std::uint64_t(1) << bit));
  }
  for (const unsigned one_in : {2, 3, 10, 40}) {
    for (int i = 0; i < 200; ++i) {
      std::uint64_t word = 0;
      for (int bit = 0; bit < 64; ++bit) word |= std::uint64_t(random() % one_in == 0) << bit;
      body(word);
    }
  }
}

}  // namespace

TEST(Bits, are_counted) {
  for_words([](std::uint64_t word) {
    int count = 0;
    for (int bit = 0; bit < 64; ++bit) count += static_cast<int>(word >> bit & 1);
    EXPECT_EQ(count_bits(word), count) << word;
    EXPECT_EQ(detail::add_up_bits(word), count) << word;
  });
}

TEST(Bits, the_nth_is_found) {
  for_words([](std::uint64_t word) {
    int n = 0;
    for (int bit = 0; bit < 64; ++bit) {
      if (word >> bit & 1) {
        EXPECT_EQ(nth_bit(word, n++), bit) << word;
      }
    }
  });
}

}  // namespace gale::test
