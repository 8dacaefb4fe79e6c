#include <gtest/gtest.h>

#ifdef GALE_ENABLE_VTK

#include <gale/io/bytes/compression.hpp>
#include <gale/io/read.hpp>

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

/// Lines come before what is compressed, bytes are of what that stands for.
TEST_F(Inflated, IsWhereVolumesSkipBytes) {
  const auto volume = [&](const std::string& fields, const std::string& data) {
    return folder.put("a.nrrd",
                      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: gzip\n" + fields + "\n" + data);
  };
  const std::vector<std::uint8_t> expected = {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'};
  const std::string member = gzip_member("headabcdefgh");
  EXPECT_EQ(test::values_of<std::uint8_t>(read(volume("byte skip: 4\n", member)).arrays[0]), expected);
  EXPECT_EQ(test::values_of<std::uint8_t>(read(volume("byte skip: 4\n", gzip_member("headabcdefgh more"))).arrays[0]),
            expected);
  EXPECT_EQ(test::values_of<std::uint8_t>(read(volume("line skip: 1\nbyte skip: 4\n", "a line\n" + member)).arrays[0]),
            expected);
  const auto error = [&](const std::string& skipped) {
    const std::string path = volume("byte skip: " + skipped + "\n", member);
    return test::error_of([&] { read(path); });
  };
  EXPECT_NE(error("5").find("7 of 8"), std::string::npos) << error("5");
  for (const std::string skipped : {"13", "9223372036854775807"})
    EXPECT_NE(error(skipped).find("what comes before its values ends after 12 of "), std::string::npos)
        << error(skipped);
  EXPECT_NE(error("-1").find("its byte skip is -1"), std::string::npos) << error("-1");
}

}  // namespace
}  // namespace gale::io

#endif
