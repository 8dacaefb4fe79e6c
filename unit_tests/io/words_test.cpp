#include <gtest/gtest.h>

#ifdef GALE_ENABLE_VTK

#include <algorithm>
#include <random>

#include <gale/io/bytes/compression.hpp>

#include "io/io_fixtures.hpp"

/// What is compressed word by word is what comes back, from zlib's inflate and from libdeflate's.
namespace gale::io {
namespace {

template <class Value>
std::string bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

template <class Value, class Make>
std::string made(std::size_t count, const Make& make) {
  std::vector<Value> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<Value>(make(k));
  return bytes_of(values);
}

class Words : public test::FileTest {
 protected:
  /// Expects to find `content` again; returns how many bytes it took.
  std::size_t compressed(const std::string& content) {
    std::vector<char> stream;
    detail::compress_by_zlib(4, content.data(), content.size(), stream);
    std::string whole(content.size(), '?');
    EXPECT_TRUE(detail::uncompress_zlib(stream.data(), stream.size(), whole.data(), whole.size()));
    EXPECT_TRUE(whole == content);
    const detail::InputFile file(folder.put("file", {stream.begin(), stream.end()}));
    const auto by_zlib = detail::inflated(file, 0);
    whole.assign(content.size() + 1, '?');
    EXPECT_EQ(by_zlib->read(whole.data(), whole.size()), content.size());
    EXPECT_TRUE(whole.compare(0, content.size(), content) == 0);
    return stream.size();
  }

  std::mt19937 random{35};
};

constexpr std::size_t block = 1 << 16;  ///< words

TEST_F(Words, OfAnyNumberOfBytesComeBack) {
  for (std::size_t size = 0; size < 70; ++size) {
    compressed(std::string(size, 'a'));
    compressed(made<std::uint8_t>(size, [&](std::size_t) { return random(); }));
    compressed(made<std::uint32_t>(size, [](std::size_t k) { return k; }).substr(0, size));
  }
}

TEST_F(Words, RepeatedAtAnyDistanceAndLengthComeBack) {
  std::string content;
  for (std::size_t words = 1; words < 9000; words = words * 5 / 4 + 1) {
    const auto some = made<std::uint32_t>(words, [&](std::size_t) { return random(); });
    content += some + some.substr(0, words % 300 * 4);
  }
  compressed(content);
  compressed(content.substr(1));
}

TEST_F(Words, TakeWhatTheirPatternNeeds) {
  const std::size_t ends = compressed(made<std::int32_t>(block, [](std::size_t k) { return 4 * k; }));
  EXPECT_LT(ends, block * 5 / 4);  // 9 bits each, and what a block costs
  EXPECT_LT(compressed(made<std::int32_t>(block, [](std::size_t k) { return (k % 2) * 70000 + k / 2; })),
            block * 13 / 8);
  EXPECT_LT(compressed(std::string(4 * block, '\7')), 2000u);
  EXPECT_LT(compressed(made<double>(block / 2, [](std::size_t k) { return k / 1000; })), 10000u);
  EXPECT_LT(compressed(made<std::uint32_t>(block, [&](std::size_t) { return random(); })), 4 * block + 300);
}

/// Bytes of which there are as many as Fibonacci's numbers say would have codes of more bits than there may be.
TEST_F(Words, MayBeOfBytesThatAreHardlyThere) {
  std::string content;
  double count = 1;
  for (int byte = 1; byte < 26; ++byte, count *= 1.61) content.append(static_cast<std::size_t>(count), char(byte));
  std::shuffle(content.begin(), content.end(), random);
  compressed(content);
}

}  // namespace
}  // namespace gale::io

#endif
