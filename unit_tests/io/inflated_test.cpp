#include <gtest/gtest.h>

#ifdef GALE_ENABLE_VTK

#include <gale/io/bytes/compression.hpp>

#include "io/io_fixtures.hpp"

/// What is uncompressed at once is what comes as a stream, and what is damaged is told alike.
namespace gale::io {
namespace {

class Inflated : public test::FileTest {
 protected:
  /// The content or the error of a file, of which `bytes` are expected.
  std::string outcome(const std::string& compressed, std::uint64_t bytes) {
    const detail::InputFile file(folder.put("file", compressed));
    std::string content(2000, '\0');
    const std::string message = test::error_of([&] {
      std::string whole;
      const auto room = [&] {
        whole.resize(bytes);
        return whole.data();
      };
      if (bytes > 0 && detail::inflate_at_once(file, 0, bytes, room)) {
        content = whole;
        return;
      }
      const auto source = detail::inflated(file, 0);
      content.resize(source->read(content.data(), content.size()));
    });
    return message == "no error" ? content : message;
  }
};

std::string zlib_stream(const std::string& content) {
  std::vector<char> compressed;
  detail::compress_by_zlib(1, content.data(), content.size(), compressed);
  return {compressed.begin(), compressed.end()};
}

std::string little_endian(std::uint32_t number) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> 8 * k);
  return bytes;
}

std::string gzip_member(const std::string& content) {
  const std::string stream = zlib_stream(content);
  std::uint32_t sum = ~0u;
  for (const char c : content) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
  }
  return std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10) + stream.substr(2, stream.size() - 6) + little_endian(~sum) +
         little_endian(static_cast<std::uint32_t>(content.size()));
}

std::string some_text() {
  std::string text;
  for (int k = 0; k < 300; ++k) text += std::to_string(k * k % 97) + ' ';
  return text;
}

TEST_F(Inflated, IsTheContentWhateverIsExpected) {
  const std::string text = some_text(), more = "and more", member = gzip_member(text);
  const std::string both = member + gzip_member(more);
  for (const std::uint64_t bytes : {std::uint64_t(0), std::uint64_t(text.size()), std::uint64_t(text.size() - 1),
                                    std::uint64_t(text.size() + more.size()), ~std::uint64_t(0)}) {
    EXPECT_EQ(outcome(zlib_stream(text), bytes), text) << bytes;
    EXPECT_EQ(outcome(member, bytes), text) << bytes;
    EXPECT_EQ(outcome(member + "what somebody appended", bytes), text) << bytes;
    EXPECT_EQ(outcome(both, bytes), text + more) << bytes;
  }
}

TEST_F(Inflated, TellsDamageAsTheStreamDoes) {
  const std::string text = some_text();
  for (const std::string& whole : {zlib_stream(text), gzip_member(text), gzip_member(text) + gzip_member("")}) {
    for (std::size_t k = 0; k < whole.size(); ++k) {
      std::string damaged = whole;
      damaged[k] ^= 1 << k % 8;
      EXPECT_EQ(outcome(damaged, text.size()), outcome(damaged, 0)) << "byte " << k << " of " << whole.size();
      EXPECT_EQ(outcome(whole.substr(0, k), text.size()), outcome(whole.substr(0, k), 0)) << "its first " << k;
    }
  }
}

}  // namespace
}  // namespace gale::io

#endif
